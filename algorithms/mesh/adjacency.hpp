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

/// A label per triangle. Triangles with equal labels have one parent each and lie in the same
/// surface and the same patch; a triangle with several parents has no_label.
using Labels = std::vector<std::uint32_t>;
constexpr std::uint32_t no_label = UINT32_MAX;

/// The triangles at each edge of a mesh; inner edges are kept apart from all others.
struct Adjacency {
    using Inner = std::vector<std::array<std::uint32_t, 2>>;
    std::vector<Inner> inner; ///< the two triangles at each inner edge, which have equal labels
                              ///< and are the only ones there; split into any number of lists
    std::vector<Edge> edges;  ///< all other edges, sorted
    IndexLists<std::uint32_t> triangles_at; ///< per edge in `edges`: its triangles, ascending
};

/// Returns labels that tell surfaces apart but not patches, from the surfaces and parents of the
/// triangles.
Labels labels_of(const IndexLists<std::uint32_t>& surfaces_of,
                 const IndexLists<std::uint32_t>& parents_of);

/// Returns the adjacency of the triangles with these edges and labels. Cost: linear.
Adjacency adjacency_of(const EdgeSides& edges, const Labels& labels);

/// A mesh that results from dividing some triangles (faces) of an old mesh.
struct Divided {
    std::span<const Triangle> triangles;       ///< indices into vertices
    const IndexLists<std::uint32_t>& faces_of; ///< per triangle: the old triangles that contain it
    std::span<const std::uint32_t> unchanged_as; ///< per old triangle: its index here if it was not
                                                 ///< divided, or UINT32_MAX
    std::span<const std::uint32_t>
        vertex_map; ///< per old vertex: its index here, in the same order;
                    ///< undefined if it is in no triangle
    std::size_t vertex_count = 0;
};

/// Returns the adjacency of the new mesh. A triangle in one face gets the label of the face, others
/// get none. Cost: a pass over the old edges, and grouping of the edges near new triangles.
Adjacency adjacency_after(const EdgeSides& old, const Labels& old_labels, const Divided& divided,
                          const Run& run = {});

/// Returns the adjacency of the triangles of a mesh that are kept, numbered in their order; vertices
/// keep their numbers. `all`, `labels`: of all triangles. The inner edges are in another order than
/// those of adjacency_of(). Cost: linear, without grouping.
Adjacency adjacency_of_kept(const Adjacency& all, const Labels& labels,
                            std::span<const Triangle> triangles, const std::vector<bool>& keep);

} // namespace terrane
