// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/input_triangles.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Sorted surfaces of each list of input triangles, each once.
IndexLists<std::uint32_t> surfaces_of_parents(const InputTriangles& inputs,
                                              const IndexLists<std::uint32_t>& parents_of,
                                              const Run& run = {});

/// The edges in which more than two triangles meet, or two that differ in the number of distinct
/// parents they have in some surface (duplicates within one surface count once). Sorted.
std::vector<Edge> find_intersection_edges(const Adjacency& adjacency, const InputTriangles& inputs,
                                          const IndexLists<std::uint32_t>& parents_of);

} // namespace terrane
