// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines the constants that control how rounding repairs contacts. They affect which conforming
// mesh results, never whether it is checked.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <terrane/algorithms/core/named_constant.hpp>

namespace terrane::rounding::detail {

/// The constants of rounding. A grid is given by the number of binary digits that it drops: its
/// spacing is 2^digits units in the last place of the largest coordinate on each axis.
///
/// (0) Few contacts are searched for doubles nearby that separate them.
/// (1) Crossing triangles of the output are snapped first, to fine grids, so that as little as
///     possible moves. This removes isolated contacts. It multiplies the contacts of surfaces that
///     are nearly coplanar over an area (touching_ridges_turned).
/// (2) If a round does not reduce the contacts to a quarter, the input triangles concerned are
///     snapped instead, and the input is arranged again. If contacts are crowded from the start
///     (coplanar_half_turned), this happens at once, because fine rounds would only multiply them.
/// (3) For a part of an arrangement (restricted.hpp) that is the last resort: what was removed would
///     be decided again. It gets all grids in place first, each as long as it removes contacts.
/// (4) No grid moves a point farther than surfaces may move. By default that is 1024 spacings of
///     the doubles, which nearly coplanar surfaces need: snapped to a grid of 512 spacings, most of
///     their parts are so far from each other that rounding to doubles does not make them cross.
struct RoundingTuning {
    std::array<int, 3> fine_digits{4, 8, 12}; ///< grids for the output, in this order
    std::array<int, 6> coarse_digits{9, 16, 20, 24, 28, 32}; ///< grids for the input, in this
                                                             ///< order, and for parts
    int allowed_digits = 10;      ///< the largest move allowed by default, as digits of a grid
    double decimal_share = 0.125; ///< inputs are decimals only if the spacing of doubles is less
                                  ///< than this share of that of the decimals
    double cluster_spacings = 16; ///< triangles are nearly coplanar within this distance of one
                                  ///< plane, in spacings of the doubles
    std::size_t few = 64; ///< most contacts that are separated by moves to doubles nearby first
    static constexpr int search_steps = 2; ///< how many doubles away along each axis
    std::size_t many = 1024;               ///< fewer contacts are never crowded
    std::size_t crowded = 8;  ///< contacts are crowded if there are fewer triangles per contact
    std::size_t sampled = 16; ///< parts of a triangle, up to twice as many, that are searched for
                              ///< contacts where these are too many to list
    std::size_t hopeless = 4; ///< contacts per triangle from which on they are not divided, unless
                              ///< they are fewer than RoundingReport::most_counted
    std::size_t multiplied = 8; ///< growth of contacts, or of triangles, in a round that counts
                                ///< as a failure
    unsigned widenings = 3;     ///< attempts per grid of the input, each on more triangles
    unsigned shrinking = 4;     ///< a round helps if it divides the contacts by at least this
};

inline constexpr RoundingTuning rounding_tuning;

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    const RoundingTuning& t = rounding_tuning;
    return {
        {"fine_digits_1", static_cast<double>(t.fine_digits[0])},
        {"fine_digits_2", static_cast<double>(t.fine_digits[1])},
        {"fine_digits_3", static_cast<double>(t.fine_digits[2])},
        {"coarse_digits_1", static_cast<double>(t.coarse_digits[0])},
        {"coarse_digits_2", static_cast<double>(t.coarse_digits[1])},
        {"coarse_digits_3", static_cast<double>(t.coarse_digits[2])},
        {"coarse_digits_4", static_cast<double>(t.coarse_digits[3])},
        {"coarse_digits_5", static_cast<double>(t.coarse_digits[4])},
        {"coarse_digits_6", static_cast<double>(t.coarse_digits[5])},
        {"allowed_digits", static_cast<double>(t.allowed_digits)},
        {"decimal_share", t.decimal_share},
        {"cluster_spacings", t.cluster_spacings},
        {"few", static_cast<double>(t.few)},
        {"search_steps", static_cast<double>(RoundingTuning::search_steps)},
        {"many", static_cast<double>(t.many)},
        {"crowded", static_cast<double>(t.crowded)},
        {"sampled", static_cast<double>(t.sampled)},
        {"hopeless", static_cast<double>(t.hopeless)},
        {"multiplied", static_cast<double>(t.multiplied)},
        {"widenings", static_cast<double>(t.widenings)},
        {"shrinking", static_cast<double>(t.shrinking)},
    };
}

} // namespace terrane::rounding::detail
