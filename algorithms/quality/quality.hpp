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

} // namespace terrane
