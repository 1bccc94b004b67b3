// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/regions/regions.hpp>

namespace terrane {

/// Finds the regions of triangles whose adjacency is known. `intersection_edges` are sorted; none
/// of them is an inner edge of the adjacency. Defined in regions.cpp.
Regions find_regions(std::span<const Point3> vertices, std::span<const Triangle> triangles,
                     const IndexLists<std::uint32_t>& surfaces_of, const Adjacency& adjacency,
                     std::span<const Edge> intersection_edges, const Run& run = {});

} // namespace terrane
