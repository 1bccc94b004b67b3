// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Parts of the report that compare the mesh of doubles with the arrangement.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane::rounding::detail {

/// Returns a bound for the distances between corners of triangles and other points.
double largest_distance(std::span<const Point3> points, std::span<const Triangle> triangles,
                        std::span<const Point3> others);

/// Counts moves of vertices in decades: see RoundingReport::moves.
std::array<std::size_t, 32> decades_of(std::span<const double> moves);

/// Completes the report of the rounding of a moved input. Where the triangles are those of the
/// arrangement all the same, each vertex has its exact point, and its move is measured: where
/// surfaces cross at a small angle, it is larger than theirs. `first` is the report of the rounding
/// before the input was moved.
void add_to_report(const MovedInput& moved, const Arrangement& arrangement,
                   const RoundingReport& first, RoundedMesh& rounded);

/// A certificate states at most this many deviations.
inline constexpr double stated_deviations = 4;

/// Tells whether two surfaces that meet in the arrangement, at points that are farther from each other
/// than terrane verify accepts, have no vertex of the mesh in common. Surfaces of which a triangle
/// vanished may be parted.
bool are_parted(const Arrangement& arrangement, const RoundedMesh& rounded);

/// Compares the regions with those of the exact surfaces and reports losses.
void report_vanished_regions(const Arrangement& arrangement, RoundedMesh& rounded);

} // namespace terrane::rounding::detail
