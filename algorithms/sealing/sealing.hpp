// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Closes gaps caused by data errors: free borders that stop short of a surface by at most a
// distance are extended to it; surfaces that extend beyond another one by at most that distance are
// trimmed. The distance can be different for each surface and for each pair of surfaces.
//
// - Extension: a strip of new triangles continues the surface along the tangent plane, a little
//   beyond the other surface; everything is arranged exactly, and the part beyond is dropped
//   exactly. Where that closes nothing (surfaces at a small angle), nor do bridges, the strip goes
//   towards the nearest points. Tangent planes come first because gaps of real models are far
//   smaller than their triangles: the surface keeps its direction, and strips of adjacent edges fit
//   together, also around corners. A strip is kept where it closes a gap, see extension_faces.hpp.
//   Last, borders that end short of another part of their own surface are extended to it.
// - Bridges: two borders that face each other in nearly one plane, of two surfaces or of one (a
//   slit, a notch), are joined by a band of triangles with corners on both. They come first: where
//   both surfaces end, strips would meet in some places and miss each other in others.
// - Trimming: the part of a surface between its free border and the curve with another surface is
//   removed if no point of it is farther than the distance from the curve.
// Guarantees: the result is an exact arrangement; only the listed changes are made; no input vertex
// moves; strips that close no gap are removed. If no gap is small enough, the result is the
// arrangement of the input itself.
// Distances are in floating point, from the ends and midpoints of the free parts of border edges to
// the nearest other surface. A part of an edge is extended as a whole or not at all. Gaps
// that stay open are listed with the reason. Cost: one arrangement if nothing is to be done;
// otherwise two or three more for each way of building strips.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// The distance for the gaps of one surface, or for those between two.
struct SealRule {
    SurfaceId surface{};              ///< of the input
    std::optional<SurfaceId> other{}; ///< none: between `surface` and any; the same as `surface`:
                                      ///< between parts of it
    double distance = 0;              ///< >= 0, unit of the input; 0: these gaps stay open
};

/// Options of seal(). For the gap between two surfaces the rule for this pair counts; without one,
/// those for the two: 0 if one of them is 0, otherwise the larger; without any, `distance`. Of
/// several rules for the same the last one counts.
struct SealOptions {
    double distance = 0;           ///< >= 0, unit of the input; with rules it may be 0: none
    ArrangeOptions arrange{};      ///< for the arrangements that are made
    std::vector<SealRule> rules{}; ///< exceptions from `distance`
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

/// Why a gap stays open.
enum class OpenReason : std::uint8_t {
    small_angle,    ///< the surfaces meet at too small an angle
    ends_beside,    ///< the other surface ends there, too, and not in nearly one plane
    partly_farther, ///< the other surface is farther than the distance for part of the edge
    ends_free,      ///< the strip that would close it has a free end there
};

/// Returns the name of a reason, as above.
std::string_view name_of(OpenReason reason);

/// Border edges of one surface that stay open by another one, or by other parts of their own, for
/// the same reason.
struct OpenGap {
    SurfaceId from{};      ///< the surface that ends there
    SurfaceId to{};        ///< the surface nearest to `place`
    OpenReason reason{};   ///< why they stay open
    std::size_t edges = 0; ///< number of border edges
    double length = 0;     ///< of their free parts
    double width = 0;      ///< largest distance
    Point3 place{};        ///< where that is
};

/// The arrangement of surfaces whose gaps are closed.
struct Sealed {
    std::vector<Surface> surfaces;   ///< those of the input; triangles of strips come last in each
                                     ///< and count as input triangles of the arrangement
    Arrangement arrangement;         ///< restricted to the kept triangles
    std::vector<SealChange> changes; ///< by kind, surface, place
    std::vector<ClosedGap> closed;   ///< by extension: by from, to, place
    unsigned passes = 0;             ///< passes in which strips were built
    std::vector<OpenGap> open;       ///< gaps that remain: by from, to, reason
    double left = 0; ///< length of the input's free borders that remain this near to another
                     ///< surface, or another part of their own
};

/// Seals the gaps between surfaces, and between parts of one. Errors: bad_option (the distance is
/// not positive and no rule has a positive one, or a rule names no surface), those of arrange().
Result<Sealed> seal(std::vector<Surface> surfaces, const SealOptions& options, const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> seal_constants();

// Lists the gaps between free borders and other surfaces, or parts of the same, and where their widths have natural
// breaks: widths that next to no gap has, between the gaps that are errors of the data and those
// that are meant.

/// The free part of an edge of a border that ends near another surface, or another part of its own.
struct SurfaceGap {
    SurfaceId from{};  ///< the surface that ends
    SurfaceId to{};    ///< the surface nearest to `place`; `from`: another part of it
    double length = 0; ///< of the free part, unit of the input
    double width = 0;  ///< largest distance from it
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
