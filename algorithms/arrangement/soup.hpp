// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Performs step (a) of the arrangement: merges all surfaces into one soup of distinct points and
// distinct triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

/// The triangles of all surfaces. Degenerate and repeated triangles are left out and listed.
/// Input vertices and triangles are numbered through all surfaces, in order.
struct Soup {
    std::vector<Point3> points;              ///< all input vertices
    UninitializedVector<Triangle> triangles; ///< the distinct ones with area; each corner is the
                                             ///< first input vertex with its coordinates
    UninitializedVector<Triangle>
        input_corners; ///< per input triangle, degenerate or not: its corners, chosen likewise
    UninitializedVector<std::uint32_t> input_of;   ///< per triangle: its input triangle, ascending
    UninitializedVector<std::uint32_t> surface_of; ///< per triangle: the surface of input_of
    UninitializedVector<Sign> turns;               ///< per triangle: its orientation seen along z
    std::vector<std::uint32_t> degenerate;         ///< input triangles without area, ascending
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {input triangle, the first with the
                                                          ///< same three points}, ascending
    EdgeSides edges;                                      ///< those of the triangles
    std::vector<std::uint32_t> first_input_triangle;      ///< per surface, and the total at the end
    std::vector<std::uint32_t> first_input_vertex;        ///< per surface, and the total at the end
};

/// Merges surfaces. Cost: linear (hashing), one predicate per triangle.
Soup merge_surfaces(std::span<const Surface> surfaces, const Run& run = {});

// The two steps of merge_surfaces(), for callers who know the edges in between:
/// Merges surfaces, but keeps repeated triangles, and groups no edges.
Soup merge_with_repeated(std::span<const Surface> surfaces, const Run& run = {});
/// Sets repeated triangles aside, given the edges of all. Returns whether there were any; the edges
/// are then grouped anew.
bool set_repeated_aside(Soup& soup, const Run& run = {});

/// Returns the box of each triangle.
std::vector<Box> boxes_of(std::span<const Point3> points, std::span<const Triangle> triangles);

} // namespace terrane
