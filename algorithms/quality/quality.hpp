// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures the quality of triangles in floating point: q = 2 r / R, where r is the radius of the
// inscribed and R that of the circumscribed circle (1 for equilateral triangles, 0 for degenerate
// ones), angles and edge lengths. Cost: linear. Source: the paper, section 4.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Computes q, in [0, 1]. The order of the corners changes no bit of it.
double quality_of(const Point3& a, const Point3& b, const Point3& c);

/// Computes the angles at a, b and c in degrees; 0 where an adjacent side has no length.
std::array<double, 3> angles_of(const Point3& a, const Point3& b, const Point3& c);

/// Distribution of a measure.
struct Spread {
    double min = 0;                      ///< the least value
    double mean = 0;                     ///< the arithmetic mean
    double max = 0;                      ///< the largest value
    std::array<double, 5> percentiles{}; ///< the 1st, 5th, 50th, 95th and 99th
};

/// Summarises values given in any order; all zero if there are none.
Spread spread_of(std::vector<double> values);

/// The quality of a set of triangles.
struct QualityReport {
    static constexpr std::size_t classes = 20; ///< of the histogram

    std::size_t triangles = 0;                    ///< number of triangles
    Spread q;                                     ///< per triangle, in [0, 1]
    Spread smallest_angle;                        ///< per triangle, in degrees
    Spread largest_angle;                         ///< per triangle, in degrees
    Spread edge_length;                           ///< each edge counted once; unit of the points
    double share_above_08 = 0;                    ///< share of the triangles with q > 0.8
    std::array<std::size_t, classes> histogram{}; ///< number of triangles by q, in classes of 0.05
    std::uint32_t worst = UINT32_MAX;             ///< the first triangle with the least q;
                                                  ///< UINT32_MAX if there is none
};

/// Measures all triangles. The result does not depend on the number of threads.
QualityReport measure_quality(std::span<const Point3> vertices, std::span<const Triangle> triangles,
                              const Run& run = {});

// Measures distances between surfaces, by code that shares nothing with the remeshing it judges.

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
