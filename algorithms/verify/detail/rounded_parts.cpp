// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrane::verifier {

RoundedParts make_rounded_parts(const Inputs& inputs, const ArrangementClaim& exact,
                                const RoundedClaim& rounded) {
    const double move = rounded.max_move.value_or(0);
    std::vector<Point3> all = inputs.vertices;
    all.insert(all.end(), rounded.vertices.begin(), rounded.vertices.end());
    // A quarter is an integer, too, unless it is below the smallest double.
    all.push_back({move, rounded.deviation, rounded.deviation / 4});
    auto [points, scale] = scale_to_integers(all);
    RoundedParts parts{inputs, exact, rounded, {}, {}, {}, {}, 0, 0, 0, scale, false, {}, {}};
    parts.max_move = points.back()[0];
    parts.deviation = points.back()[1];
    parts.quarter = parts.deviation / 4;
    points.pop_back();
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(inputs.vertices.size());
    parts.input_points.assign(points.begin(), middle);
    parts.points.assign(middle, points.end());
    parts.set_aside = find_set_aside(inputs, parts.input_points);
    parts.children = children_of(rounded.parents_of, inputs.triangles.size());
    parts.exact_children = children_of(exact.parents_of, inputs.triangles.size());
    parts.same_triangles = exact.vertices.size() == rounded.vertices.size() &&
                           exact.triangles == rounded.triangles &&
                           exact.parents_of == rounded.parents_of;
    return parts;
}

double default_max_deviation(const Inputs& inputs) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{infinity, infinity, infinity};
    std::array<double, 3> high{-infinity, -infinity, -infinity};
    double largest = 0;
    for (const Triangle& t : inputs.triangles)
        for (const std::uint32_t corner : t) {
            const Point3& p = inputs.vertices[corner];
            const std::array<double, 3> at{p.x, p.y, p.z};
            for (std::size_t i = 0; i < 3; ++i) {
                low[i] = std::min(low[i], at[i]);
                high[i] = std::max(high[i], at[i]);
                largest = std::max(largest, std::fabs(at[i]));
            }
        }
    double diagonal = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (low[i] < high[i]) diagonal = std::hypot(diagonal, high[i] * 0x1p-20 - low[i] * 0x1p-20);
    constexpr double least = 16 * std::numeric_limits<double>::denorm_min();
    return std::max({diagonal, largest * 0x1p-40, least});
}

} // namespace terrane::verifier
