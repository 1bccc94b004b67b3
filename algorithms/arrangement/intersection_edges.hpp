// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Returns for each list of input triangles their surfaces; sorted, unique.
IndexLists<std::uint32_t> surfaces_of_parents(const InputTriangles& inputs,
                                              const IndexLists<std::uint32_t>& parents_of,
                                              const Run& run = {});

/// Finds the edges in which more than two triangles meet, or two that differ in the number of their
/// distinct parents in some surface (duplicates within one surface count once). Sorted.
std::vector<Edge> find_intersection_edges(const Adjacency& adjacency, const InputTriangles& inputs,
                                          const IndexLists<std::uint32_t>& parents_of);

} // namespace terrane
