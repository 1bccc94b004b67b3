// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_rounded_orientation of rounded_parts.hpp.
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

void check_rounded_orientation(const RoundedParts& parts, Violations& found) {
    for (std::uint32_t t = 0; t < parts.rounded.triangles.size(); ++t) {
        const std::uint32_t parent = parts.rounded.parents_of[t].front();
        const auto corners = parts.corners(t);
        if (sgn(dot(normal_of(corners), normal_of(parts.input_corners(parent)))) > 0) continue;
        const Squared height = squared_height(corners);
        if (sgn(height.below) == 0 || within(height, parts.deviation)) continue;
        found.push_back({Rule::R19_orientation,
                         {t, parent},
                         "triangle " + text(t) + " is turned over: its first parent, input " +
                             "triangle " + text(parent) + ", faces the other side"});
    }
}

} // namespace terrane::verifier
