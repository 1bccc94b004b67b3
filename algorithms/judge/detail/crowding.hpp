// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds where exact parts are so near to each other that rounding may join them, and how much it may
// move from one region to another there.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>

namespace terrane::judging {

struct Crowding {
    /// Whether a point is near two triangles with no common edge.
    [[nodiscard]] bool is_near_others(const Point3& p) const;

    double reach = 0;          ///< distance below which parts are near each other
    std::vector<bool> crowded; ///< per exact vertex: near others, or a corner near others
    IndexLists<std::uint32_t>
        cells_near;                    ///< per exact vertex: cells near it of which it is no corner
    std::vector<double> area_in_doubt; ///< per cell
    std::vector<Point3> places;        ///< of exact vertices, the nearest doubles
    std::unique_ptr<TriangleTree> tree; ///< of the target's triangles at these places
};

/// Finds parts nearer than 16 bounds. Cost: O(n log n) and, for each near pair of a vertex and a triangle,
/// the triangles at the vertex.
/// `clashing`: triangles that are near others, too.
Crowding find_crowding(const Target& target, const Cells& cells, double bound,
                       std::span<const std::uint32_t> clashing);

/// Whether a height of a triangle is at most `height`.
bool is_thin(const Point3& a, const Point3& b, const Point3& c, double height);

} // namespace terrane::judging
