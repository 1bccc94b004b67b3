// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures distances between surfaces, by code that shares nothing with the remeshing it judges.
#pragma once

#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Samples each triangle of `from` at 13 points (corners, midpoints of edges, seven inner points)
/// and returns the largest distance of a sample to `to`: a lower bound of the one-sided Hausdorff
/// distance. Floating point, in the unit of the points; infinite where `to` has no triangles. Cost:
/// 13 nearest-triangle queries per triangle.
double sampled_distance(const Surface& from, const Surface& to, const Run& run = {});

/// Returns the distance of a point of `from` to `to` that is within 5 % of the largest one (the
/// one-sided Hausdorff distance), up to rounding errors. Triangles are divided until the bound of
/// each part shows it. Floating point, in the unit of the points; infinite where `to` has no
/// triangles. Ends soon after a request to stop, with a distance that is too small. Reports its
/// progress as stage "measure". Cost: some
/// nearest-triangle queries per triangle, and more where the distance is near the largest.
double measured_distance(const Surface& from, const Surface& to, const Run& run = {});

/// Returns an upper bound of the one-sided Hausdorff distance (up to rounding) that exceeds it by
/// at most `tolerance`. Triangles are subdivided until the bound of each part is tight enough; the
/// cost grows quickly, so use it for small surfaces.
double distance_bound(const Surface& from, const Surface& to, double tolerance,
                      const Run& run = {});

/// Tells whether each point of `from` is shown to be at most `bound` away from `to` (up to rounding
/// errors of distances). Triangles are divided until the bound of each part shows it; so much
/// that `bound` itself is reached only within some 2^-16 of their size counts as not shown. Ends with false soon
/// after a request to stop. Cost: some nearest-triangle queries per triangle, and more where the
/// distance is near the bound.
bool is_within(const Surface& from, const Surface& to, double bound, const Run& run = {});

/// Measured distances between the two states of one surface: `out` from the second mesh to the
/// first, `back` from the first to the second.
struct Deviation {
    double out = 0;  ///< from the second mesh to the first, unit of the points
    double back = 0; ///< from the first mesh to the second, unit of the points
};

/// Computes one Deviation per surface. Both meshes must have the same surfaces. Reports its progress
/// as stage "measure".
std::vector<Deviation> deviations_of(const Mesh& before, const Mesh& after, const Run& run = {});

} // namespace terrane
