// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures of border loops, in floating point. Private to holes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane::detail {

/// A loop with the triangle at each of its edges.
struct TracedLoop {
    std::vector<std::uint32_t> vertices;  ///< in order
    std::vector<std::uint32_t> triangles; ///< per edge, from vertex i to i + 1: one at it
    std::uint32_t part = 0;
    std::uint32_t shared = 0;
};

/// Fills in length, area, centre.
void measure_loop(const Soup& soup, const TracedLoop& traced, BorderLoop& loop);

/// Longest diagonal of the box round these points.
double diagonal_of(std::span<const Point3> points, std::span<const std::uint32_t> vertices);

/// Fills in throw and width of a hole, and says whether it is a gap by the rule.
bool is_fault_gap(const Soup& soup, const TracedLoop& traced, const GapRule& rule,
                  BorderLoop& loop);

} // namespace terrane::detail
