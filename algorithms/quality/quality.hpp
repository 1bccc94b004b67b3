// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How good triangles are, in floating point: q = 2 r / R (r the radius of the inscribed circle, R
// of the circumscribed one; 1 for an equilateral triangle, 0 for one without area), angles,
// lengths. Cost: linear. Source: the paper, section 4.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// In [0, 1].
double quality_of(const Point3& a, const Point3& b, const Point3& c);

/// Degrees, at a, b and c; 0 where a side has no length.
std::array<double, 3> angles_of(const Point3& a, const Point3& b, const Point3& c);

/// How a measure is spread.
struct Spread {
    double min = 0, mean = 0, max = 0;
    std::array<double, 5> percentiles{}; ///< 1, 5, 50, 95 and 99 of a hundred are at most this
};

/// Of values in any order; all zero where there is none.
Spread spread_of(std::vector<double> values);

struct QualityReport {
    static constexpr std::size_t classes = 20;

    std::size_t triangles = 0;
    Spread q;
    Spread smallest_angle;                        ///< of each triangle, in degrees
    Spread largest_angle;                         ///< of each triangle, in degrees
    Spread edge_length;                           ///< of each edge once; unit of the points
    double share_above_08 = 0;                    ///< of the triangles, q > 0.8
    std::array<std::size_t, classes> histogram{}; ///< triangles by q, in classes of 0.05
    std::uint32_t worst = UINT32_MAX;             ///< a triangle of least q, the first; or none
};

/// The same numbers for any number of threads.
QualityReport measure_quality(std::span<const Point3> vertices, std::span<const Triangle> triangles,
                              const Run& run = {});

} // namespace terrane
