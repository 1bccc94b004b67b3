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
    RoundedParts parts{inputs, exact, rounded, {}, {}, {}, {}, 0, 0, 0, scale, false, {}, 0, {}};
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
    double largest = 0;
    for (const Triangle& t : inputs.triangles)
        for (const std::uint32_t corner : t) {
            const auto& [x, y, z] = inputs.vertices[corner];
            largest = std::max({largest, std::fabs(x), std::fabs(y), std::fabs(z)});
        }
    return std::max(largest * 0x1p-40, 16 * std::numeric_limits<double>::denorm_min());
}

} // namespace terrane::verifier
