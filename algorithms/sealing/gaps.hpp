// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lists the gaps between free borders and other surfaces, and where their widths have natural
// breaks: widths that next to no gap has, between the gaps that are errors of the data and those
// that are meant.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// The free part of an edge of a border that ends near another surface.
struct SurfaceGap {
    SurfaceId from{};  ///< the surface that ends
    SurfaceId to{};    ///< the surface nearest to `place`
    double length = 0; ///< of the free part, unit of the input
    double width = 0;  ///< largest distance from the nearest other surface
    Point3 place{};    ///< where that is
};

/// Widths that next to no gap has.
struct GapBreak {
    double low = 0;       ///< width of the widest gap below, unit of the input
    double high = 0;      ///< width of the first gap above, or the largest that was looked at
    double distance = 0;  ///< a round number in between
    std::size_t gaps = 0; ///< number of gaps of at most `low` that are above the break before
    double length = 0;    ///< of these
};

/// Finds all gaps of at most `widest`, by width. Distances are in floating point, from the ends and
/// midpoints of the free parts of border edges, as in seal(). Errors: bad_option (`widest` is not
/// positive), interrupted.
Result<std::vector<SurfaceGap>> find_gaps(const Arrangement& arrangement, double widest,
                                          const Run& run = {});

/// Finds the natural breaks among gaps of at most `widest`, in ascending order: intervals in which
/// the width at least triples and that hold at most a hundredth of the length of all gaps. The
/// widest gaps are below the last break if there are none up to three times their width.
/// Precondition: the gaps are sorted by width.
std::vector<GapBreak> find_breaks(std::span<const SurfaceGap> gaps, double widest);

/// Lists the constants that decide the breaks.
std::vector<NamedConstant> gap_constants();

} // namespace terrane
