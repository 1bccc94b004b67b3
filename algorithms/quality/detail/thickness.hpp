// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Limits the tolerance of remeshing where blocks are thin.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/quality/detail/sizes.hpp>

namespace terrane::quality::detail {

/// Computes, per triangle, the thickness of the blocks at it: the least distance to another triangle
/// in front of it or behind it, along its normal at four of its points, of at most reach_of;
/// infinite if there is none. Triangles that are inclined to it do not count: a block is not thin
/// where two surfaces cross. The values are computed in floating point. Cost: a search for pairs of
/// boxes.
std::vector<double> thickness_of(std::span<const Point3> points,
                                 std::span<const Triangle> triangles,
                                 std::span<const double> reach_of, const Run& run);

/// Computes, per triangle, a bound: that of its sheet or, if that is less, `share` times the
/// thickness of the block there. Of the triangles of the sheet within about one wanted length, that
/// with the largest thickness decides, so that wedges do not end in triangles that can't be changed
/// at all. Empty if no triangle is limited. The values are a choice, no part of a proof. Cost: that
/// of thickness_of, and the triangles within that length for each that is limited.
std::vector<double> bounds_by_thickness(const Mesh& mesh, const Features& features,
                                        const Sizes& sizes, double share, const Run& run);

} // namespace terrane::quality::detail
