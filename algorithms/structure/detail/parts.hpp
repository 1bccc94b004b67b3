// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Steps of build_structure. Private to structure.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane::structure::detail {

/// Per vertex its place in the lexicographic order.
std::vector<std::uint32_t> ranks_of(const std::vector<Point3>& vertices);

/// Lines and corners, once interfaces and patches are known; the lines of patches, too.
void add_lines(const Mesh& mesh, const EdgeSides& edges, const std::vector<std::uint32_t>& ranks,
               Structure& structure);

/// Blocks with their names, once interfaces are known.
void add_blocks(const Mesh& mesh, const Volumes& volumes, Structure& structure);

/// Twice the area times the unit normal, in front.
Point3 area_vector(const Mesh& mesh, std::uint32_t triangle);

} // namespace terrane::structure::detail
