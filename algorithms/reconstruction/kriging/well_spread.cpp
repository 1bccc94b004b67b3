// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/well_spread.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {

std::vector<std::uint32_t> well_spread_in_plane(std::span<const Point3> points, std::size_t count) {
    std::vector<std::uint32_t> chosen;
    if (points.size() <= count) {
        for (std::uint32_t i = 0; i < points.size(); ++i) chosen.push_back(i);
        return chosen;
    }
    Point3 mean;
    for (const Point3& p : points) {
        const auto n = static_cast<double>(points.size());
        mean = {mean.x + p.x / n, mean.y + p.y / n, mean.z + p.z / n};
    }
    // Squares of distances, in a unit in which they can't overflow.
    double extent = 0;
    for (const Point3& p : points)
        extent = std::max({extent, std::abs(p.x - mean.x), std::abs(p.y - mean.y)});
    const int exponent = extent > 0 && std::isfinite(extent) ? std::ilogb(extent) : 0;
    std::vector<double> x, y, distance;
    for (const Point3& p : points) {
        x.push_back(std::ldexp(p.x - mean.x, -exponent));
        y.push_back(std::ldexp(p.y - mean.y, -exponent));
        distance.push_back(x.back() * x.back() + y.back() * y.back());
    }
    constexpr double equal = 1 - 2e-9; // squares differ by more than rounding
    while (chosen.size() < count) {
        const double farthest = *std::max_element(distance.begin(), distance.end());
        if (!(farthest > 0)) break;
        std::uint32_t best = 0;
        double height = -1;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if (distance[i] < equal * farthest) continue;
            const double off = std::abs(points[i].z - mean.z);
            if (off <= height) continue;
            best = i;
            height = off;
        }
        if (chosen.empty())
            std::fill(distance.begin(), distance.end(), std::numeric_limits<double>::infinity());
        chosen.push_back(best);
        const double from_x = x[best], from_y = y[best];
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double dx = x[i] - from_x, dy = y[i] - from_y, square = dx * dx + dy * dy;
            distance[i] = square < distance[i] ? square : distance[i];
        }
    }
    return chosen;
}

SpreadPairs well_spread_pairs(std::span<const Point3> points, std::size_t count,
                              std::size_t pairs) {
    SpreadPairs result{well_spread_in_plane(points, count), 0};
    std::vector<bool> taken(points.size(), false);
    for (const auto i : result.chosen) taken[i] = true;
    double mean = 0;
    for (const Point3& p : points) mean += p.z / static_cast<double>(points.size());
    std::vector<double> gaps;
    // Where all points are taken, no order decides which of them have a say.
    pairs = result.chosen.size() == points.size() ? points.size()
                                                  : std::min(pairs, result.chosen.size());
    for (std::size_t k = 0; k < pairs; ++k) {
        const Point3 p = points[result.chosen[k]];
        constexpr double equal = 1 + 1e-9; // distances differ by more than rounding
        double least = std::numeric_limits<double>::infinity(), gap = least;
        auto best = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const double d = length_in_plane(points[i].x - p.x, points[i].y - p.y);
            if (d > 0 && d < gap) gap = d;
            if (taken[i] || !(d > 0) || d > equal * least) continue;
            const bool better = best == points.size() || d * equal < least ||
                                std::abs(points[i].z - mean) > std::abs(points[best].z - mean);
            least = std::min(least, d);
            if (better) best = i;
        }
        if (std::isfinite(gap)) gaps.push_back(gap);
        if (best == points.size()) continue;
        taken[best] = true;
        result.chosen.push_back(best);
    }
    if (gaps.empty()) return result;
    const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::nth_element(gaps.begin(), middle, gaps.end());
    result.gap = *middle;
    return result;
}

double rounding_of(std::span<const Point3> data, unsigned degree) {
    double largest = 0;
    for (const Point3& p : data) largest = std::max(largest, std::abs(p.z));
    const double unit = std::nextafter(largest, HUGE_VAL) - largest;
    // A rounding is spread evenly over a unit. Estimates are sums of hundreds of terms: by the oracle's
    // planes, they have twelve of them, those of degree 2 twice that.
    return unit * std::sqrt(12.0 * std::max(degree, 1U) / 12);
}

} // namespace terrane
