// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Steps of build_structure(): add_lines() is defined in lines.cpp, add_blocks() in blocks.cpp, the
// others in structure.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane::structure::detail {

/// Returns the lexicographic rank of each vertex.
std::vector<std::uint32_t> ranks_of(const std::vector<Point3>& vertices);

/// Adds lines and corners, and the lines of patches; interfaces and patches must be known.
void add_lines(const Mesh& mesh, const EdgeSides& edges, const std::vector<std::uint32_t>& ranks,
               Structure& structure);

/// Adds blocks, without names; interfaces must be known.
void add_blocks(const Mesh& mesh, const Volumes& volumes, Structure& structure);

/// Returns twice the area times the unit normal on the front side.
Point3 area_vector(const Mesh& mesh, std::uint32_t triangle);

/// Returns the area of a triangle.
double triangle_area(const Mesh& mesh, std::uint32_t triangle);

} // namespace terrane::structure::detail
