// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Regions of space, and parts of open surfaces, by expressions over surfaces.
#pragma once

#include <terrane/capi/base.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/surfaces.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A region of space, by its boundary, or a part of an open surface.
typedef struct terrane_selected terrane_selected;

/// The winding numbers of points inside of a closed surface.
typedef int32_t terrane_inside_rule;
enum {
    TERRANE_INSIDE_NONZERO = 0,  ///< all but 0
    TERRANE_INSIDE_POSITIVE = 1, ///< 1, 2, ...
    TERRANE_INSIDE_ODD = 2       ///< ..., -1, 1, 3, ...
};

/// Options of terrane_select.
typedef struct terrane_select_options {
    size_t struct_size;       ///< sizeof(terrane_select_options)
    double max_move;          ///< as in terrane_round_options
    terrane_inside_rule rule; ///< what is inside of each closed surface
    int32_t fractions;        ///< not 0: volumes are computed as fractions, too
} terrane_select_options;

/// A part of a region that is connected through more than edges and points.
typedef struct terrane_selected_piece {
    double volume;      ///< the double nearest to the exact one, cubic unit
    uint64_t triangles; ///< that bound it; 0: it was too thin for doubles
} terrane_selected_piece;

/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_select_options_init(terrane_select_options* options,
                                                     size_t struct_size);

/// Selects a region by an expression over the surfaces, by their names, such as "(a | b) - c" or
/// "salt & below(topography)", or a part of an open surface: "fault & inside(body)". Free it with
/// terrane_selected_free. Errors: BAD_OPTION (a mistake in the expression, with its column; a name
/// of no surface; a region without an end), NOT_CLOSED (a closed operand that bounds no solid, an open
/// one that ends inside a part), those of terrane_arrange and terrane_round.
TERRANE_API terrane_code terrane_select(const terrane_surfaces* surfaces, const char* expression,
                                        const terrane_select_options* options,
                                        const terrane_run* run, terrane_selected** out,
                                        terrane_error** error);
/// Frees a selection.
TERRANE_API void terrane_selected_free(terrane_selected* selected);
/// Returns the boundary, whose triangles face outwards, or the part of a surface; a part of the handle. Its
/// surfaces and parents are those of the input.
TERRANE_API const terrane_mesh* terrane_selected_mesh(const terrane_selected* selected);
/// Returns 1 if a part of an open surface is selected, which has no pieces and no volume.
TERRANE_API int terrane_selected_is_surface(const terrane_selected* selected);
/// Returns the pieces, from the one with the least vertex on.
TERRANE_API const terrane_selected_piece* terrane_selected_pieces(const terrane_selected* selected,
                                                                  size_t* count);
/// Returns, per triangle of the mesh, the piece that it bounds.
TERRANE_API const uint32_t* terrane_selected_piece_of(const terrane_selected* selected,
                                                      size_t* count);
/// Returns the number of bounded parts of space without the region.
TERRANE_API size_t terrane_selected_cavities(const terrane_selected* selected);
/// Returns the double nearest to the exact volume, in cubic units.
TERRANE_API double terrane_selected_volume(const terrane_selected* selected);
/// Returns the volume of a piece as a reduced fraction, or of all for TERRANE_NONE; "" if options did not ask for
/// it.
TERRANE_API const char* terrane_selected_exact_volume(const terrane_selected* selected,
                                                      uint32_t piece);

#ifdef __cplusplus
}
#endif
