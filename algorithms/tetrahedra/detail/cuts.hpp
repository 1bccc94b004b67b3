// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tetrahedra/detail/findings.hpp>
#include <terrane/algorithms/tetrahedra/detail/places.hpp>

namespace terrane::tetrahedra::detail {

/// Checks the nodes of a mesh that was split against the definition in split_nodes.hpp: twins have
/// the nodes in front of and behind their face, the tetrahedra on the two sides of any other face
/// share its nodes, and two tetrahedra share a node of a twin only if such faces connect them
/// there. Without twins it does nothing.
class CutCheck {
public:
    CutCheck(const Subject& subject, const Places& places);

    /// Takes in a face with a tetrahedron on either side. face: its number in the list, or none.
    void pass(std::uint32_t face, const Triangle& key, const std::array<std::uint32_t, 2>& sides);

    /// After all faces.
    void finish();

private:
    void check_twins();
    [[nodiscard]] Triangle nodes_at(std::uint32_t tetrahedron, const Triangle& key) const;
    [[nodiscard]] std::uint32_t corner_at(std::uint32_t tetrahedron, std::uint32_t place) const;
    void wrong(std::uint32_t face);

    const Subject& subject_;
    const Places& places_;
    bool active_;
    std::vector<std::uint32_t> twin_of_; ///< per face in front of a cut: the one behind, or none
    std::vector<bool> on_cut_;           ///< per place: a corner of a twin
    DisjointSets sets_;                  ///< corners of tetrahedra that are to share a node
};

} // namespace terrane::tetrahedra::detail
