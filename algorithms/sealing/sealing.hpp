// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Closes gaps caused by data errors: free borders that stop short of another surface by at most a
// distance are extended to it; surfaces that extend beyond another one by at most that distance are
// trimmed.
//
// - Extension: a strip of new triangles continues the surface along the tangent plane, a little
//   beyond the other surface; everything is arranged exactly, and the part beyond is dropped
//   exactly. Where that closes nothing (surfaces at a small angle), the strip goes towards the
//   nearest points. Tangent planes come first because gaps of real models are far smaller than
//   their triangles: the surface keeps its direction, and strips of adjacent edges fit together,
//   also around corners. A strip is kept where it closes a gap, see extension_faces.hpp.
// - Trimming: the part of a surface between its free border and the curve with another surface is
//   removed if no point of it is farther than the distance from the curve.
// Guarantees: the result is an exact arrangement; only the listed changes are made; no input vertex
// moves; strips that close no gap are removed. If no gap is small enough, the result is the
// arrangement of the input itself.
// Distances are in floating point, from the ends and midpoints of the free parts of border edges to
// the nearest other surface. A part of an edge is extended as a whole or not at all; gaps between
// parts of one surface are ignored. Cost: one arrangement if nothing is to be done; otherwise two
// or three more for each way of building strips.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// Options of seal().
struct SealOptions {
    double distance = 0;      ///< > 0, unit of the input
    ArrangeOptions arrange{}; ///< for the arrangements that are made
};

/// The way in which a border changed: a strip was added, or the part beyond a surface was removed.
enum class SealKind : std::uint8_t { extended, trimmed };

/// The change of one connected part of a border.
struct SealChange {
    SealKind kind = SealKind::extended; ///< extension or trimming
    SurfaceId surface{};                ///< of the input
    double length = 0;                  ///< of the free border there, before the change
    double largest = 0; ///< largest distance: of the border from the nearest other surface, or of
                        ///< the trimmed part from the curve
    Point3 place{};     ///< where that is
    std::size_t triangles = 0; ///< of the arrangement: added, or removed
};

/// The free part of a border edge that a strip extends to another surface.
struct ClosedGap {
    SurfaceId from{};                       ///< the surface that ended there
    SurfaceId to{};                         ///< the surface nearest to `place`
    double length = 0;                      ///< of the free part
    double width = 0;                       ///< largest distance from the nearest other surface
    Point3 place{};                         ///< where that is
    std::vector<std::uint32_t> triangles{}; ///< of its strip, as input triangles of the
                                            ///< arrangement, ascending
};

/// The arrangement of surfaces whose gaps are closed.
struct Sealed {
    std::vector<Surface> surfaces;   ///< those of the input; triangles of strips come last in each
                                     ///< and count as input triangles of the arrangement
    Arrangement arrangement;         ///< restricted to the kept triangles
    std::vector<SealChange> changes; ///< by kind, surface, place
    std::vector<ClosedGap> closed;   ///< by extension: by from, to, place
    unsigned passes = 0;             ///< passes in which strips were built
    double left = 0; ///< length of the input's free borders that remain this near to another
                     ///< surface, for example where that surface ends beside them
};

/// Seals the gaps between surfaces. Errors: bad_option (the distance is not positive), those of
/// arrange().
Result<Sealed> seal(std::vector<Surface> surfaces, const SealOptions& options, const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> seal_constants();

} // namespace terrane
