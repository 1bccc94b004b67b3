// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of sealing that decide the size of strips.
#pragma once

#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::sealing::detail {

/// Strips are cut exactly where they meet other surfaces, so their size decides only which surfaces
/// they reach.
struct SealConstants : Constants {
    /// Width of strips along the tangent plane, in gaps: enough where surfaces meet at 15
    /// degrees or more.
    double width_per_gap = add("width_per_gap", 4);
    /// Rounds that remove useless strips; more than one is needed only where strips depend
    /// on each other.
    unsigned most_rounds = add("most_rounds", 4);
    /// Least width, in units in the last place of the coordinates: narrower strips have no
    /// meaningful direction.
    double least_width = add("least_width", 1024);
    /// Samples per edge of a triangle whose distance from a curve is judged.
    std::size_t overshoot_samples = add("overshoot_samples", 8);
    /// Distance up to which the ends of a gap look for the surface that the gap is measured to,
    /// in distances of sealing.
    double end_reach = add("end_reach", 2);
    /// Least cosine between the direction in which a surface would go on and that to another part
    /// of it: parts to the side, as all of a plane are, form no gap.
    double least_ahead = add("least_ahead", 0.5);
    /// Least cosine between the direction in which a surface would go on at a border and the
    /// opposite of that at a border which it faces: up to 30 degrees is nearly one plane.
    double least_facing = add("least_facing", 0.866);
    /// Least cosine between the direction in which a surface would go on and the way to a border
    /// which it faces. Negative, since the edges of curved surfaces miss each other by more than
    /// small gaps are wide; the other border of a narrow surface, behind it, has -1.
    double least_beside = add("least_beside", -0.5);
    /// Least cosine between one step of a bridge along a border and the next: a right angle at
    /// corners, and a little more.
    double least_turn = add("least_turn", -0.2);
    /// Largest sine, of the angle between a strip and the surface that it is to meet, that counts
    /// as too small an angle where a strip has closed nothing: the inverse of width_per_gap.
    double most_flat = add("most_flat", 0.25);
};

inline constexpr SealConstants constants{};

} // namespace terrane::sealing::detail
