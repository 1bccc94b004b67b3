// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures border loops, in floating point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane::holes::detail {

/// A border loop with a triangle at each of its edges.
struct TracedLoop {
    std::vector<std::uint32_t> vertices;  ///< in order
    std::vector<std::uint32_t> triangles; ///< per edge (from vertex i to i + 1): a triangle at it
    std::uint32_t part = 0;
    std::uint32_t shared = 0;
};

/// Sets length, area and centre.
void measure_loop(const Soup& soup, const TracedLoop& traced, BorderLoop& loop);

/// Computes the diagonal of the bounding box of these points.
double diagonal_of(std::span<const Point3> points, std::span<const std::uint32_t> vertices);

/// Sets throw and width of a hole, and tells whether it is a fault gap.
bool is_fault_gap(const Soup& soup, const TracedLoop& traced, const GapRule& rule,
                  BorderLoop& loop);

} // namespace terrane::holes::detail
