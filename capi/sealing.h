// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Closing gaps: between surfaces, and between horizons and the boundary of a volume of interest.
#pragma once

#include <terrane/capi/arrangement.h>
#include <terrane/capi/base.h>
#include <terrane/capi/surfaces.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The arrangement of surfaces whose gaps are closed.
typedef struct terrane_sealed terrane_sealed;
/// Surfaces that were extended to a boundary.
typedef struct terrane_extended terrane_extended;

/// The distance for the gaps of one surface, or for those between two.
typedef struct terrane_seal_rule {
    uint32_t surface; ///< number of a surface
    uint32_t other;   ///< number of the other one; TERRANE_NONE: any; the same: between parts of it
    double distance;  ///< >= 0, unit of the input; 0: these gaps stay open
} terrane_seal_rule;

/// Options of terrane_seal.
typedef struct terrane_seal_options {
    size_t struct_size;             ///< sizeof(terrane_seal_options)
    double distance;                ///< largest width of gaps to close, >= 0, unit of the input; 0:
                                    ///< by rules alone
    const terrane_seal_rule* rules; ///< exceptions from `distance`; NULL: none
    size_t rule_count;              ///< number of rules
} terrane_seal_options;

/// The free part of a border edge that was extended to another surface.
typedef struct terrane_closed_gap {
    uint32_t from;   ///< the surface that ended there
    uint32_t to;     ///< the surface nearest to `place`
    double length;   ///< of the free part, unit of the input
    double width;    ///< largest distance from the nearest other surface
    double place[3]; ///< where that is
} terrane_closed_gap;

/// Border edges that stay open by another surface, for the same reason.
typedef struct terrane_open_gap {
    uint32_t from;    ///< the surface that ends there
    uint32_t to;      ///< the surface nearest to `place`
    int32_t reason;   ///< see terrane_open_reason_name
    int32_t reserved; ///< 0
    uint64_t edges;   ///< number of border edges
    double length;    ///< of their free parts
    double width;     ///< largest distance
    double place[3];  ///< where that is
} terrane_open_gap;

/// The change of one connected part of a border by sealing.
typedef struct terrane_seal_change {
    int32_t is_trimmed; ///< 1: the part beyond another surface was removed; 0: the border was
                        ///< extended
    uint32_t surface;   ///< number of the surface
    double length;      ///< of the free border there, before the change
    double largest;     ///< largest distance
    double place[3];    ///< where that is
    uint64_t triangles; ///< of the arrangement: added, or removed
} terrane_seal_change;

/// A connected part of a border inside the volume of interest.
typedef struct terrane_extended_border {
    uint32_t surface; ///< number of the surface
    int32_t reached;  ///< 1: it reached the boundary and was extended; 0: it stays as it is
    double length;    ///< of the free border, unit of the input
    double place[3];  ///< its lexicographically least vertex
    uint64_t edges;   ///< border edges of the input
} terrane_extended_border;

/// Gives options their defaults: no distance, no rules. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_seal_options_init(terrane_seal_options* options,
                                                   size_t struct_size);
/// Returns why a gap stays open, in words: "small angle", "ends beside", ...; "unknown" for other
/// numbers.
TERRANE_API const char* terrane_open_reason_name(int32_t reason);

/// Closes gaps between surfaces: free borders that stop short of a surface are extended to it, and
/// what extends beyond another surface is trimmed, up to a distance. No vertex of the input moves.
/// Free the result with terrane_sealed_free. Errors: BAD_OPTION (no positive distance, or a rule
/// names no surface), those of terrane_arrange.
TERRANE_API terrane_code terrane_seal(const terrane_surfaces* surfaces,
                                      const terrane_seal_options* options, const terrane_run* run,
                                      terrane_sealed** out, terrane_error** error);
/// Frees sealed surfaces.
TERRANE_API void terrane_sealed_free(terrane_sealed* sealed);
/// Returns the surfaces with the triangles that close gaps, which come last in each; a part of the
/// handle.
TERRANE_API const terrane_surfaces* terrane_sealed_surfaces(const terrane_sealed* sealed);
/// Returns the arrangement of these surfaces without trimmed parts; a part of the handle.
TERRANE_API const terrane_arrangement* terrane_sealed_arrangement(const terrane_sealed* sealed);
/// Returns the changes, by kind, surface and place.
TERRANE_API const terrane_seal_change* terrane_sealed_changes(const terrane_sealed* sealed,
                                                              size_t* count);
/// Returns the gaps that were closed by extension, by surfaces and place.
TERRANE_API const terrane_closed_gap* terrane_sealed_closed(const terrane_sealed* sealed,
                                                            size_t* count);
/// Returns the gaps that remain, by surfaces and reason.
TERRANE_API const terrane_open_gap* terrane_sealed_open(const terrane_sealed* sealed,
                                                        size_t* count);
/// Returns the length of free borders that remain nearer to another surface than the distance; NaN
/// for NULL.
TERRANE_API double terrane_sealed_left(const terrane_sealed* sealed);
/// Sets *distance to the one that the widths of gaps suggest for sealing: a natural break among
/// them; 0 if there is none. `edge_length` > 0 is the median length of edges, and `surfaces` is
/// NULL; or it is 0, and computed from `surfaces`, which were arranged. Errors: BAD_OPTION, INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_choose_seal(const terrane_arrangement* arrangement,
                                             const terrane_surfaces* surfaces, double edge_length,
                                             const terrane_run* run, double* distance,
                                             terrane_error** error);

/// Joins what is nearer than `tolerance` (> 0, unit of the input): borders and creases of surfaces, and
/// gaps and overlaps that are thinner. No surface moves by more. Sets *left to the number of thin gaps,
/// overlaps and units that were not joined, or SIZE_MAX if nothing was, since the moves were not shown
/// to be within the tolerance; left may be NULL. Free the surfaces with terrane_surfaces_free. Errors:
/// BAD_OPTION, those of terrane_arrange and terrane_round.
TERRANE_API terrane_code terrane_join_within(const terrane_surfaces* surfaces, double tolerance,
                                             const terrane_run* run, size_t* left,
                                             terrane_surfaces** out, terrane_error** error);

/// Extends horizons that end inside a volume of interest to its boundary, by at most `limit` (> 0,
/// unit of the input). `boundary` lists the numbers of the surfaces that bound the volume,
/// ascending. Free the result with terrane_extended_free. Errors: BAD_OPTION, BAD_INDEX,
/// NOT_CLOSED, those of terrane_arrange.
TERRANE_API terrane_code terrane_extend_to_boundary(const terrane_surfaces* surfaces,
                                                    const uint32_t* boundary, size_t boundary_count,
                                                    double limit, const terrane_run* run,
                                                    terrane_extended** out, terrane_error** error);
/// Frees extended surfaces.
TERRANE_API void terrane_extended_free(terrane_extended* extended);
/// Returns the surfaces with the new triangles, which come last in each; a part of the handle.
TERRANE_API const terrane_surfaces* terrane_extended_surfaces(const terrane_extended* extended);
/// Returns the borders inside the volume, by surface and place.
TERRANE_API const terrane_extended_border*
terrane_extended_borders(const terrane_extended* extended, size_t* count);

#ifdef __cplusplus
}
#endif
