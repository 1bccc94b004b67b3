// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the leaks that matter: the gaps that join blocks.
//
// The model is made once more with all gaps closed up to the last natural break in their widths
// (choose_seal()), without blocks that are certainly dirt (small_volume_for()). A gap separates
// blocks if a triangle of the strip that closes it has different volumes on its sides: opening this
// gap alone joins the two. That is decided exactly. The other gaps up to the break are harmless by
// the same criterion: tips, borders that reach beyond another surface, gaps next to others that stay
// open. Not seen are gaps that are wider than the break, and those that sealing can't close. Where two gaps lead between the same blocks, both are found.
// Cost: that of seal() and find_volumes().
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/structure/free_borders.hpp>

namespace terrane {

/// The effect of closing a leak.
enum class LeakVerdict : std::uint8_t {
    separates, ///< it separates blocks
    harmless,  ///< it separates none
    wide,      ///< unknown: the gap is wider than those that were closed
};

/// The leaks of a model, judged.
struct LeakAdvice {
    double distance = 0;               ///< up to which gaps were closed; 0: there is no break
    std::vector<Leak> separating{};    ///< gaps that separate blocks, one entry for each pair of
                                       ///< surfaces, the longest first; decade is 0, borders
                                       ///< counts edges, which lengths count as a whole
    std::vector<LeakVerdict> verdicts; ///< per entry of leaks_of(borders)
};

/// Judges the leaks of an arrangement that was not sealed, whose model has these free borders;
/// `options` are those of the arrangement. Errors: those of arrange_within; bad_option if it was
/// sealed.
Result<LeakAdvice> judge_leaks(const Arranged& arranged, std::span<const FreeBorder> borders,
                               const ArrangeWithinOptions& options = {}, const Run& run = {});

} // namespace terrane
