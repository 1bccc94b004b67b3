// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_rounded_orientation of rounded_parts.hpp.
#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

namespace {

using Corners = std::array<const Vector4*, 3>;

Vector3 normal_of(const Corners& corners) {
    return cross(difference(*corners[1], *corners[0]), difference(*corners[2], *corners[0]));
}

/// A side of a triangle.
struct Side {
    std::uint32_t parent; ///< the first one
    Edge edge;
    bool upwards; ///< whether it runs from the lower to the higher vertex
    std::uint32_t triangle;
};

std::vector<Side> sides_by_parent(const RoundedClaim& rounded) {
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < rounded.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto from = rounded.triangles[t][i], to = rounded.triangles[t][(i + 1) % 3];
            sides.push_back({rounded.parents_of[t].front(),
                             {std::min(from, to), std::max(from, to)},
                             from < to,
                             t});
        }
    std::ranges::sort(
        sides, {}, [](const Side& s) { return std::tie(s.parent, s.edge, s.upwards, s.triangle); });
    return sides;
}

void report(std::uint32_t triangle, std::uint32_t parent, Violations& found) {
    found.push_back({Rule::R19_orientation,
                     {triangle, parent},
                     "triangle " + text(triangle) + " is turned over: its first parent, input " +
                         "triangle " + text(parent) + ", faces the other side"});
}

} // namespace

void check_rounded_orientation(const RoundedParts& parts, Violations& found) {
    if (parts.same_triangles) return;
    const RoundedClaim& rounded = parts.rounded;
    std::vector<bool> thin(rounded.triangles.size());
    for (std::uint32_t t = 0; t < rounded.triangles.size(); ++t) {
        const std::uint32_t parent = rounded.parents_of[t].front();
        const Corners corners = parts.corners(t);
        if (sgn(dot(normal_of(corners), normal_of(parts.input_corners(parent)))) > 0) continue;
        const Squared height = squared_height(corners);
        thin[t] = sgn(height.below) == 0 || within(height, parts.deviation);
        if (!thin[t]) report(t, parent, found);
    }
    const auto sides = sides_by_parent(rounded);
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
        while (last < sides.size() && sides[last].parent == sides[first].parent &&
               sides[last].edge == sides[first].edge)
            ++last;
        if (last - first != 2 || sides[first].upwards != sides[first + 1].upwards) continue;
        for (std::size_t i = first; i < last; ++i)
            if (thin[sides[i].triangle]) report(sides[i].triangle, sides[i].parent, found);
    }
}

} // namespace terrane::verifier
