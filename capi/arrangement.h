// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The exact arrangement of surfaces, the part of it in a volume of interest, and its rounding to
// doubles.
#pragma once

#include <terrane/capi/base.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/surfaces.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The exact arrangement of surfaces. Input vertices and triangles are numbered through all
/// surfaces.
typedef struct terrane_arrangement terrane_arrangement;
/// The part of an arrangement in a volume of interest.
typedef struct terrane_cut terrane_cut;

/// Options of terrane_arrange.
typedef struct terrane_arrange_options {
    size_t struct_size; ///< sizeof(terrane_arrange_options)
    const char* search; ///< method of the box search, "auto", "hierarchy", "mixed", "grid", ...;
                        ///< NULL: "auto". It changes the time, never the result
} terrane_arrange_options;

/// Options of terrane_round.
typedef struct terrane_round_options {
    size_t struct_size;  ///< sizeof(terrane_round_options)
    uint32_t max_rounds; ///< limit on the rounds of snapping; 0: nearest doubles only; default 8
    int32_t full_check;  ///< not 0: each pair of triangles whose boxes overlap is tested by exact
                         ///< predicates, also where a proven bound would do
    double max_move;     ///< the farthest that surfaces may move, unit of the input; < 0 (the
                         ///< default): 1024 times the spacing of doubles at the largest coordinate
} terrane_round_options;

/// The counts of an arrangement.
typedef struct terrane_arrangement_summary {
    uint64_t input_triangles;    ///< number of triangles of all surfaces
    uint64_t candidates;         ///< pairs of triangles whose boxes overlap
    uint64_t improper_contacts;  ///< pairs of input triangles that meet improperly
    uint64_t divided;            ///< input triangles that were triangulated
    uint64_t constructed_points; ///< distinct points that are no input vertices
    uint64_t vertices;           ///< of the result
    uint64_t triangles;          ///< of the result
    uint64_t intersection_edges; ///< of the result
} terrane_arrangement_summary;

/// The effect of the cut on one surface. Areas are in squared units, in floating point.
typedef struct terrane_surface_cut {
    double area_inside;      ///< of the part that was kept
    double area_outside;     ///< of the part that was dropped
    double area_on_boundary; ///< of the boundary's own faces, all of it
    double open_length;      ///< of its borders that are free inside the volume
    uint64_t pieces;         ///< parts of the kept surface, connected across edges
    uint64_t open_borders;   ///< connected borders that are free inside the volume
} terrane_surface_cut;

/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_arrange_options_init(terrane_arrange_options* options,
                                                      size_t struct_size);
/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_round_options_init(terrane_round_options* options,
                                                    size_t struct_size);

/// Computes the exact arrangement: no two of its triangles meet other than in a shared vertex or
/// edge, and each input triangle with area is the union of the triangles that name it as a parent.
/// There is no tolerance. Free it with terrane_arrangement_free. Errors: BAD_OPTION, UNSUPPORTED,
/// INTERRUPTED, OUT_OF_MEMORY, INTERNAL.
TERRANE_API terrane_code terrane_arrange(const terrane_surfaces* surfaces,
                                         const terrane_arrange_options* options,
                                         const terrane_run* run, terrane_arrangement** out,
                                         terrane_error** error);
/// Frees an arrangement.
TERRANE_API void terrane_arrangement_free(terrane_arrangement* arrangement);
/// Copies the counts; `struct_size` is sizeof(terrane_arrangement_summary). Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_arrangement_get_summary(const terrane_arrangement* arrangement,
                                                         terrane_arrangement_summary* summary,
                                                         size_t struct_size);
/// Returns the vertices, each as the doubles nearest to it, 3 numbers: the input vertices in use,
/// then constructed points in lexicographic order.
TERRANE_API const double* terrane_arrangement_vertices(const terrane_arrangement* arrangement,
                                                       size_t* vertex_count);
/// Returns the triangles, 3 indices of vertices each.
TERRANE_API const uint32_t* terrane_arrangement_triangles(const terrane_arrangement* arrangement,
                                                          size_t* triangle_count);
/// Gives, per triangle, the input triangles that contain it, ascending. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_arrangement_parents(const terrane_arrangement* arrangement,
                                                     terrane_lists* lists);
/// Gives, per triangle, the surfaces of its parents, ascending. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_arrangement_surfaces(const terrane_arrangement* arrangement,
                                                      terrane_lists* lists);
/// Returns the edges along which surfaces meet, 2 vertices each, sorted: `count` edges.
TERRANE_API const uint32_t*
terrane_arrangement_intersection_edges(const terrane_arrangement* arrangement, size_t* count);
/// Returns the input triangles without area, ascending.
TERRANE_API const uint32_t* terrane_arrangement_degenerate(const terrane_arrangement* arrangement,
                                                           size_t* count);
/// Writes an exact coordinate (axis 0, 1, 2) of a vertex as a reduced fraction, "-5/3" or "7", into
/// `buffer`, cut short to `size` bytes with NUL; *length becomes the length of the whole text.
/// `buffer` may be NULL if `size` is 0, `length` may be NULL. Errors: BAD_INDEX, BAD_ARGUMENT,
/// OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_arrangement_coordinate(const terrane_arrangement* arrangement,
                                                        size_t vertex, int axis, char* buffer,
                                                        size_t size, size_t* length,
                                                        terrane_error** error);
/// Writes the canonical digest of the arrangement, "sha256:" and 64 digits, likewise. It depends on
/// the geometry alone, not on the numbering. `surfaces` are those that were arranged. Errors:
/// BAD_ARGUMENT, BAD_OPTION, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_arrangement_digest(const terrane_arrangement* arrangement,
                                                    const terrane_surfaces* surfaces,
                                                    const terrane_run* run, char* buffer,
                                                    size_t size, size_t* length,
                                                    terrane_error** error);

/// Restricts an arrangement to a volume of interest, exactly. `boundary` lists the numbers of the
/// surfaces that bound it, ascending; they are closed together. Free the cut with terrane_cut_free.
/// Errors: NOT_CLOSED, BAD_INDEX, BAD_OPTION, INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_cut_to_volume(const terrane_arrangement* arrangement,
                                               const uint32_t* boundary, size_t boundary_count,
                                               const terrane_run* run, terrane_cut** out,
                                               terrane_error** error);
/// Frees a cut.
TERRANE_API void terrane_cut_free(terrane_cut* cut);
/// Returns the inside with the boundary, a part of the cut.
TERRANE_API const terrane_arrangement* terrane_cut_arrangement(const terrane_cut* cut);
/// Returns the effect of the cut per surface.
TERRANE_API const terrane_surface_cut* terrane_cut_surfaces(const terrane_cut* cut,
                                                            size_t* surface_count);

/// Merges the blocks whose exact volume is below `least` (cubic unit, > 0) with neighbours, by
/// removing triangles. *merged (may be NULL) becomes the number of these blocks. Errors:
/// BAD_OPTION, INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_merge_small_blocks(const terrane_arrangement* arrangement,
                                                    double least, const terrane_run* run,
                                                    terrane_arrangement** out, size_t* merged,
                                                    terrane_error** error);

/// Rounds an arrangement to doubles, with iterated snap rounding where the nearest ones are not
/// conforming. Ask terrane_mesh_is_conforming whether the result is; terrane_mesh_contacts names
/// the pairs of triangles in the way. Free it with terrane_mesh_free. Errors: BAD_OPTION (no
/// doubles are within max_move), BAD_NUMBER (a point beyond the largest double), INTERRUPTED,
/// OUT_OF_MEMORY, INTERNAL.
TERRANE_API terrane_code terrane_round(const terrane_arrangement* arrangement,
                                       const terrane_round_options* options, const terrane_run* run,
                                       terrane_mesh** out, terrane_error** error);

#ifdef __cplusplus
}
#endif
