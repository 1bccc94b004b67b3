// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which nodes are at one point. Only a cut (split_nodes.hpp) has several nodes at a point; the
// check joins them, so that a mesh that was split is judged as the one that it was before.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/tetrahedra/detail/findings.hpp>

namespace terrane::tetrahedra::detail {

/// The points of the nodes in use. A place is the lowest node at a point.
struct Places {
    std::vector<std::uint32_t> of_node;   ///< per node; itself where it is not in use
    std::vector<std::uint32_t> of_vertex; ///< per vertex of the surface mesh: the place with
                                          ///< exactly its coordinates, or none
    /// The places of some nodes.
    template <std::size_t N>
    [[nodiscard]] std::array<std::uint32_t, N> of(std::array<std::uint32_t, N> nodes) const {
        for (std::uint32_t& node : nodes) node = of_node[node];
        return nodes;
    }
};

/// Finds the places. Without twins each node is a place of its own; reports a doubled_node where
/// two are at one point.
Places find_places(const Subject& subject);

/// Reports a missing_vertex for each vertex of a triangle that needs faces and has no place.
void check_vertices(const Subject& subject, const Places& places);

} // namespace terrane::tetrahedra::detail
