// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Which input triangles are which: numbers count through all surfaces.
struct InputTriangles {
    std::vector<std::uint32_t> first;        ///< per surface, and the total at the end
    std::vector<std::uint32_t> first_vertex; ///< the same for input vertices
    UninitializedVector<Triangle> corners;   ///< per input triangle: input vertices at the first
                                             ///< place where their coordinates occur
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {input triangle, the first with the
                                                          ///< same three points}, ascending

    [[nodiscard]] std::uint32_t surface_of(std::uint32_t triangle) const;
    /// The first triangle with the same three points: itself where it is no duplicate.
    [[nodiscard]] std::uint32_t first_same(std::uint32_t triangle) const;
};

/// Sorted surfaces of each list of input triangles, each once.
IndexLists<std::uint32_t> surfaces_of_parents(const InputTriangles& inputs,
                                              const IndexLists<std::uint32_t>& parents_of,
                                              const Run& run = {});

/// The edges in which more than two triangles meet, or two that differ in the number of distinct
/// parents they have in some surface (duplicates within one surface count once). Sorted.
std::vector<Edge> find_intersection_edges(const Adjacency& adjacency, const InputTriangles& inputs,
                                          const IndexLists<std::uint32_t>& parents_of);

} // namespace terrane
