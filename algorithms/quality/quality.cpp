// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/quality.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

/// Computes the angle opposite to the first of three sides.
double angle_opposite(double a, double b, double c) {
    if (!(b > 0) || !(c > 0)) return 0;
    // Kahan's half-angle formula: the law of cosines cancels where the angle is small.
    const double s = (a + b + c) / 2;
    const double sine = std::max(0.0, ((s - b) / b) * ((s - c) / c));
    const double cosine = std::max(0.0, (s / b) * ((s - a) / c));
    return 2 * std::atan2(std::sqrt(sine), std::sqrt(cosine)) * 180 / std::acos(-1.0);
}

/// Computes the least and the largest angle: those opposite to the shortest and the longest side.
std::pair<double, double> extreme_angles(const Point3& a, const Point3& b, const Point3& c) {
    std::array<double, 3> sides{distance_between(b, c), distance_between(c, a),
                                distance_between(a, b)};
    std::sort(sides.begin(), sides.end());
    return {angle_opposite(sides[0], sides[1], sides[2]),
            angle_opposite(sides[2], sides[0], sides[1])};
}

std::vector<double> edge_lengths(std::span<const Point3> vertices,
                                 std::span<const Triangle> triangles, const Run& run) {
    std::vector<double> lengths;
    lengths.reserve(triangles.size() * 2);
    group_edges(triangles, vertices.size(), run)
        .for_each([&](std::uint32_t low, std::uint32_t high, auto) {
            lengths.push_back(distance_between(vertices[low], vertices[high]));
        });
    return lengths;
}

} // namespace

double quality_of(const Point3& first, const Point3& second, const Point3& third) {
    // The corners are sorted, so that the result is the same in any order to the last bit.
    std::array<Point3, 3> corners{first, second, third};
    std::sort(corners.begin(), corners.end(), [](const Point3& p, const Point3& q) {
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    });
    const auto& [a, b, c] = corners;
    const Point3 u = minus(b, a), v = minus(c, a);
    const double size = std::max({std::fabs(u.x), std::fabs(u.y), std::fabs(u.z), std::fabs(v.x),
                                  std::fabs(v.y), std::fabs(v.z)});
    if (!(size > 0) || !std::isfinite(size)) return 0;
    const auto scaled = [&](const Point3& d) { return Point3{d.x / size, d.y / size, d.z / size}; };
    const Point3 p = scaled(u), q = scaled(v), r = minus(q, p), n = cross(p, q);
    const double la = std::sqrt(dot(p, p)), lb = std::sqrt(dot(q, q)), lc = std::sqrt(dot(r, r));
    const double sides = la * lb * lc * (la + lb + lc);
    // The radii are r = area / s and R = a b c / (4 area), where s is half the perimeter.
    return sides > 0 ? std::clamp(4 * dot(n, n) / sides, 0.0, 1.0) : 0;
}

std::array<double, 3> angles_of(const Point3& a, const Point3& b, const Point3& c) {
    const double la = distance_between(b, c), lb = distance_between(c, a),
                 lc = distance_between(a, b);
    return {angle_opposite(la, lb, lc), angle_opposite(lb, lc, la), angle_opposite(lc, la, lb)};
}

Spread spread_of(std::vector<double> values) {
    const StandardArithmetic guard;
    Spread spread;
    if (values.empty()) return spread;
    double sum = 0;
    for (const double v : values) sum += v;
    spread.mean = sum / static_cast<double>(values.size());
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    spread.min = *least;
    spread.max = *largest;
    constexpr std::array<std::size_t, 5> hundredths{1, 5, 50, 95, 99};
    auto first = values.begin();
    for (std::size_t i = 0; i < hundredths.size(); ++i) {
        const auto place =
            values.begin() + static_cast<std::ptrdiff_t>(
                                 std::min(values.size() - 1, values.size() * hundredths[i] / 100));
        std::nth_element(first, place, values.end());
        spread.percentiles[i] = *place;
        first = place;
    }
    return spread;
}

QualityReport measure_quality(std::span<const Point3> vertices, std::span<const Triangle> triangles,
                              const Run& run) {
    const StandardArithmetic guard;
    QualityReport report;
    report.triangles = triangles.size();
    if (triangles.empty()) return report;
    const std::size_t count = triangles.size();
    std::vector<double> q(count), smallest(count), largest(count);
    const auto measure = [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            const auto& [i, j, k] = triangles[t];
            q[t] = quality_of(vertices[i], vertices[j], vertices[k]);
            std::tie(smallest[t], largest[t]) =
                extreme_angles(vertices[i], vertices[j], vertices[k]);
        }
    };
    both(
        run, [&] { for_ranges(count, run, measure); },
        [&] { report.edge_length = spread_of(edge_lengths(vertices, triangles, run)); });
    for (const double x : q) {
        const auto place = static_cast<std::size_t>(x * QualityReport::classes);
        ++report.histogram[std::min(place, QualityReport::classes - 1)];
    }
    const auto good = std::count_if(q.begin(), q.end(), [](double x) { return x > 0.8; });
    report.share_above_08 = static_cast<double>(good) / static_cast<double>(count);
    report.worst = static_cast<std::uint32_t>(std::min_element(q.begin(), q.end()) - q.begin());
    both(
        run,
        [&] {
            report.q = spread_of(std::move(q));
            report.smallest_angle = spread_of(std::move(smallest));
        },
        [&] { report.largest_angle = spread_of(std::move(largest)); });
    return report;
}

} // namespace terrane
