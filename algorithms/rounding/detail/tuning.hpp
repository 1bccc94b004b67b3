// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines the constants that control how rounding repairs contacts. They affect which conforming
// mesh results, never whether it is checked.
#pragma once

#include <array>
#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::rounding::detail {

/// The constants of rounding. A grid is given by the number of binary digits that it drops: its
/// spacing is 2^digits units in the last place of the largest coordinate on each axis, but see (4).
///
/// (0) Few contacts are searched for doubles nearby that separate them.
/// (1) Crossing triangles of the output are snapped first, to fine grids, so that as little as
///     possible moves. This removes isolated contacts. It multiplies the contacts of surfaces that
///     are nearly coplanar over an area (touching_ridges_turned).
/// (2) If a round does not reduce the contacts to a quarter, the input triangles concerned are
///     snapped instead, and the input is arranged again. If contacts are crowded from the start
///     (coplanar_half_turned), this happens at once, because fine rounds would only multiply them.
/// (3) For a part of an arrangement (restricted.hpp) that is the last resort: the removed part
///     would be decided again. It gets all grids in place first, each as long as it removes
///     contacts.
/// (4) If all that fails, it is done once more with grids of one spacing on all axes, then a third
///     time, and the contacts left at the end of each repair are repaired place by place
///     (places.hpp), so that one place does not keep others from it.
/// (5) No grid moves a point farther than surfaces may move. By default that is 1024 spacings of
///     the doubles, which nearly coplanar surfaces need: snapped to a grid of 512 spacings, most of
///     their parts are so far from each other that rounding to doubles does not make them cross.
struct RoundingTuning : Constants {
    /// Grids for the output, in this order.
    std::array<int, 2> fine_digits = add<int>({"fine_digits_1", "fine_digits_2"}, {4, 8});
    /// Grids for the input, in this order, and for parts.
    std::array<int, 6> coarse_digits =
        add<int>({"coarse_digits_1", "coarse_digits_2", "coarse_digits_3", "coarse_digits_4",
                  "coarse_digits_5", "coarse_digits_6"},
                 {9, 16, 20, 24, 28, 32});
    /// Grids for a place that is repaired by itself, in this order, as far as the limit of moves allows.
    std::array<int, 2> place_digits = add<int>({"place_digits_1", "place_digits_2"}, {4, 6});
    /// Rounds on each of them.
    unsigned place_rounds = add("place_rounds", 4);
    /// How often all places that are left are repaired again, and how often what a place needs around it grows.
    unsigned place_repeats = add("place_repeats", 8);
    /// So many times as many attempts with moved inputs are made if all have failed before.
    unsigned more_attempts = add("more_attempts", 3);
    /// Digits that the limit of moves gets at first, and more each time, when one is looked for that would do.
    int limit_digits = add("limit_digits", 4);
    /// The largest move allowed by default, as digits of a grid.
    int allowed_digits = add("allowed_digits", 10);
    /// Inputs are decimals only if the spacing of doubles is less than this share of that of the
    /// decimals.
    double decimal_share = add("decimal_share", 0.125);
    /// Triangles are nearly coplanar within this many spacings of the doubles from one plane.
    double cluster_spacings = add("cluster_spacings", 16);
    /// A frame has the planes of at least this share of the contacts in clusters: most of those in
    /// other planes would stay.
    double cluster_share = add("cluster_share", 0.75);
    /// So few contacts are separated by moves to doubles nearby first.
    std::size_t few = add("few", 64);
    /// How many doubles away along each axis.
    int search_steps = add("search_steps", 2);
    /// Fewer contacts are never crowded.
    std::size_t many = add("many", 1024);
    /// Contacts are crowded if there are fewer triangles per contact.
    std::size_t crowded = add("crowded", 8);
    /// Contacts of a sample of one in 32 input triangles are crowded if there are at least
    /// RoundingReport::least_sampled, and fewer triangles per contact than this.
    std::size_t sampled_crowded = add("sampled_crowded", 512);
    /// So many parts of a triangle, or up to twice, tell with which others it is in contact where
    /// contacts are too many to list.
    std::size_t sampled = add("sampled", 16);
    /// So many contacts per triangle are never divided, unless there are fewer than
    /// RoundingReport::most_counted.
    std::size_t hopeless = add("hopeless", 4);
    /// Growth of contacts, or of triangles, in a round that counts as a failure.
    std::size_t multiplied = add("multiplied", 8);
    /// Attempts per grid of the input, each on more triangles.
    unsigned widenings = add("widenings", 3);
    /// A round helps if it divides the contacts by at least this.
    unsigned shrinking = add("shrinking", 4);
};

inline constexpr RoundingTuning rounding_tuning{};

} // namespace terrane::rounding::detail
