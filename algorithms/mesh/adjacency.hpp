// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Triangles of one label lie in the same single surface and the same patch, and each has one
/// parent; no_label: it has several.
using Labels = std::vector<std::uint32_t>;
constexpr std::uint32_t no_label = UINT32_MAX;

/// How the triangles of a mesh hang together over its edges, the plain ones told from the rest.
struct Adjacency {
    using Inner = std::vector<std::array<std::uint32_t, 2>>;
    std::vector<Inner> inner; ///< the two triangles at each inner edge: one with no others at it
                              ///< and of the same label; in any number of lists
    std::vector<Edge> edges;  ///< all other edges, sorted
    IndexLists<std::uint32_t> triangles_at; ///< per edge of these: the triangles at it, ascending
};

/// By surface alone, from the surfaces and parents of triangles.
Labels labels_of(const IndexLists<std::uint32_t>& surfaces_of,
                 const IndexLists<std::uint32_t>& parents_of);

/// `labels`: per triangle. Cost: linear.
Adjacency adjacency_of(const EdgeSides& edges, const Labels& labels);

/// A mesh that came from another one by dividing some triangles.
struct Divided {
    std::span<const Triangle> triangles;         ///< indices into vertices
    const IndexLists<std::uint32_t>& faces_of;   ///< per triangle: the old ones that contain it
    std::span<const std::uint32_t> unchanged_as; ///< per old triangle: the same triangle here, or
                                                 ///< UINT32_MAX for none
    std::span<const std::uint32_t>
        vertex_map; ///< per old vertex: its index here, in the same order;
                    ///< anything where it is in no triangle
    std::size_t vertex_count = 0;
};

/// The same of the new mesh; a triangle with one face keeps its label, others have none. Cost: a
/// pass over the old edges, and grouping those near new triangles.
Adjacency adjacency_after(const EdgeSides& old, const Labels& old_labels, const Divided& divided,
                          const Run& run = {});

} // namespace terrane
