// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Closes gaps that are errors of the data: free borders that stop short of another surface by at
// most a distance are extended onto it, those that reach beyond it by at most that are trimmed.
//
// - Extended: a strip of new triangles goes on from the border along the tangent plane, a little
//   beyond the other surface; all is arranged exactly, and exactly what lies beyond is dropped.
//   Where that closes nothing (surfaces at a small angle), the strip goes towards the nearest
//   points. Tangent planes come first since gaps of real models are far smaller than their
//   triangles: the surface continues as it was, and strips of neighbouring edges fit together,
//   round corners too. A strip is judged by what closes, see strip_cells.hpp.
// - Trimmed: the part of a surface between its free border and the curve with another one, if no
//   point of it is farther than the distance from the curve.
// Guarantees: the result is an exact arrangement; nothing but what is listed changes; no vertex of
// the input moves; a strip that closes no gap is not there, and parts none of the others. Where no
// gap is small enough it is the arrangement of the input itself.
// Distances are in floating point, from the ends and middles of the free parts of border edges to
// the nearest other surface; a part of an edge is extended as a whole or not at all; a gap of a
// surface to itself is none.
// Cost: one arrangement where there is nothing to do, then two or three for each way of making
// strips.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// Options of seal().
struct SealOptions {
    double distance = 0;      ///< > 0, unit of the input
    ArrangeOptions arrange{}; ///< for the arrangements that are made
};

/// What was done to a border: a strip was added, or what reached beyond was removed.
enum class SealKind : std::uint8_t { extended, trimmed };

/// One connected part of a border.
struct SealChange {
    SealKind kind = SealKind::extended; ///< what was done
    std::uint32_t surface = 0;          ///< of the input
    double length = 0;                  ///< of the free border there, before
    double largest = 0; ///< distance: of the border from the nearest other surface, or of what
                        ///< is trimmed from the curve
    Point3 place{};     ///< where it is largest
    std::size_t triangles = 0; ///< of the arrangement: added, or removed
};

/// Surfaces whose gaps are closed, arranged.
struct Sealed {
    std::vector<Surface> surfaces; ///< of the input; triangles of strips stand last in each, and so
                                   ///< count among the input triangles of the arrangement
    Arrangement arrangement;       ///< restricted to what is kept
    std::vector<SealChange> changes; ///< by kind, surface, place
    unsigned passes = 0;             ///< in which strips were made
    double left = 0; ///< length of the input's free borders that are still this near to another
                     ///< surface, as where they end beyond it, beside its own border
};

/// Errors: bad_option (the distance is not positive), those of arrange.
Result<Sealed> seal(std::vector<Surface> surfaces, const SealOptions& options, const Run& run = {});

} // namespace terrane
