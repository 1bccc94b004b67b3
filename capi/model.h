// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The volumes that surfaces enclose, and models: a mesh with its blocks, which have names.
#pragma once

#include <terrane/capi/arrangement.h>
#include <terrane/capi/base.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/structure.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The volumes of a mesh or of an arrangement: 0 is the outside, 1, 2, ... are the blocks.
typedef struct terrane_volumes terrane_volumes;
/// A mesh with its blocks, numbered as those of the exact arrangement.
typedef struct terrane_model terrane_model;

/// A mesh whose near features were joined, with its arrangement. Experimental.
typedef struct terrane_simplified terrane_simplified;

/// Options of terrane_simplify. Lengths are in the unit of the mesh.
typedef struct terrane_simplify_options {
    size_t struct_size; ///< sizeof(terrane_simplify_options)
    double resolution;  ///< places that are nearer are joined, if they can be; > 0
    double max_move;    ///< no surface goes farther than this; 0: resolution
    double edge_length; ///< of the triangles that are made first; 0: six resolutions
    int32_t dissolve;   ///< not 0: blocks thinner than the resolution, on average, may go
    int32_t reserved;   ///< 0
} terrane_simplify_options;

/// The changes of a simplification.
typedef struct terrane_simplify_report {
    double max_move;   ///< limit of all movements, shown in both directions
    uint64_t corners;  ///< joins of two corners
    uint64_t curves;   ///< joins of places of two curves
    uint64_t sheets;   ///< joins of other places of surfaces
    uint64_t divided;  ///< edges divided where surfaces are near
    uint64_t left;     ///< near places that were left alone
    uint64_t changed;  ///< blocks that did not stay one and the same
    uint64_t vanished; ///< surfaces that vanished
    uint32_t rounds;   ///< arrangements of moved surfaces
    uint32_t attempts; ///< number of attempts
} terrane_simplify_report;

/// A unit of a stratigraphic column.
typedef struct terrane_column_unit {
    const char* name;    ///< of the unit; not empty, and in no other entry
    const char* surface; ///< name of the horizon at its base; NULL: the lowest unit, which needs
                         ///< none
    double age;          ///< of its base, in any unit of time before present; NaN: not stated
    int32_t is_erosive;  ///< not 0: its base is erosive
    int32_t reserved;    ///< 0
} terrane_column_unit;

/// Options of terrane_make_model.
typedef struct terrane_model_options {
    size_t struct_size;                ///< sizeof(terrane_model_options)
    const terrane_column_unit* column; ///< units from the top down, which name the blocks; NULL:
                                       ///< none
    size_t unit_count;                 ///< number of units
} terrane_model_options;

/// Gives options their defaults: no column. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_model_options_init(terrane_model_options* options,
                                                    size_t struct_size);

/// Finds the volumes that a conforming mesh encloses, exactly. A mesh without proof is proven
/// first. Free them with terrane_volumes_free. Errors: IMPROPER_CONTACT, INTERRUPTED,
/// OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_find_volumes(const terrane_mesh* mesh, const terrane_run* run,
                                              terrane_volumes** out, terrane_error** error);
/// Finds the volumes of an arrangement, before any rounding. Errors: INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_find_exact_volumes(const terrane_arrangement* arrangement,
                                                    const terrane_run* run, terrane_volumes** out,
                                                    terrane_error** error);
/// Frees volumes.
TERRANE_API void terrane_volumes_free(terrane_volumes* volumes);
/// Returns, per triangle, the volume in front of it and the one behind it: `triangle_count` pairs.
/// They are equal where the triangle dangles.
TERRANE_API const uint32_t* terrane_volumes_of_sides(const terrane_volumes* volumes,
                                                     size_t* triangle_count);
/// Returns, per volume, the double nearest to its exact measure, in cubic units; [0] is infinite, as
/// the outside has no end.
TERRANE_API const double* terrane_volumes_measures(const terrane_volumes* volumes, size_t* count);
/// Returns the double nearest to the measure of all blocks together; 0 without a handle.
TERRANE_API double terrane_volumes_total(const terrane_volumes* volumes);
/// Writes the exact measure of a block as a reduced fraction, "125/6", into `buffer`, cut short to
/// `size` bytes with NUL; *length becomes the length of the whole text. The first call for a handle
/// takes the time for all volumes: some seconds for 10 000 constructed corners. Errors: BAD_INDEX,
/// BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_volumes_exact(const terrane_volumes* volumes, size_t volume,
                                               char* buffer, size_t size, size_t* length,
                                               terrane_error** error);
/// Finds for each point, 3 numbers, the volume that contains it, exactly, and writes its number to
/// blocks[]. A point on a triangle counts to the side of greater x, else greater y, else greater z.
/// The volumes are those of a mesh. Errors: BAD_NUMBER with the point, BAD_OPTION (volumes of an
/// arrangement), INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_locate_points(const terrane_volumes* volumes, const double* points,
                                               size_t point_count, const terrane_run* run,
                                               uint32_t* blocks, terrane_error** error);
/// Builds the corners, lines, patches, interfaces and blocks of a mesh from its volumes. Free it
/// with terrane_structure_free. Errors: BAD_OPTION (volumes of an arrangement), OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_build_structure(const terrane_volumes* volumes,
                                                 terrane_structure** out, terrane_error** error);

/// Gives options their defaults: no resolution. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_simplify_options_init(terrane_simplify_options* options,
                                                       size_t struct_size);
/// Joins places of a conforming mesh that are nearer than a resolution. Experimental: what is joined
/// may change. The triangles of the result can be improved then, and its arrangement, mesh and
/// improved mesh make a model. A mesh without proof is proven first. Free the result with
/// terrane_simplified_free. Errors: IMPROPER_CONTACT, BAD_OPTION (also where it is not shown that no
/// surface goes farther than max_move), NOTHING_TO_DO, INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_simplify(const terrane_mesh* mesh,
                                          const terrane_simplify_options* options,
                                          const terrane_run* run, terrane_simplified** out,
                                          terrane_error** error);
/// Frees a simplified mesh.
TERRANE_API void terrane_simplified_free(terrane_simplified* simplified);
/// Returns the moved surfaces, in the order of the mesh before, a part of the handle.
TERRANE_API const terrane_surfaces*
terrane_simplified_surfaces(const terrane_simplified* simplified);
/// Returns the arrangement of the moved surfaces, a part of the handle.
TERRANE_API const terrane_arrangement*
terrane_simplified_arrangement(const terrane_simplified* simplified);
/// Returns the conforming mesh that the arrangement was rounded to, a part of the handle.
TERRANE_API const terrane_mesh* terrane_simplified_mesh(const terrane_simplified* simplified);
/// Copies the report; `struct_size` is sizeof(terrane_simplify_report). Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_simplified_get_report(const terrane_simplified* simplified,
                                                       terrane_simplify_report* report,
                                                       size_t struct_size);
/// Returns, per volume of the simplified mesh, the volume before that most of it was.
TERRANE_API const uint32_t* terrane_simplified_block_before(const terrane_simplified* simplified,
                                                            size_t* count);
/// Returns the blocks before that were thinner than the resolution and are there still, or were left
/// alone since joining changed them.
TERRANE_API const uint32_t* terrane_simplified_kept(const terrane_simplified* simplified,
                                                    size_t* count);
/// Tells whether each surface of the simplified mesh, as it was improved, is shown to be within the
/// resolution of what it was before it was simplified, and that within the resolution of it:
/// *is_shown becomes 1 or 0. Errors: BAD_OPTION (the handles do not belong together),
/// OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_simplified_keeps_resolution(const terrane_simplified* simplified,
                                                             const terrane_improved* improved,
                                                             const terrane_run* run,
                                                             int32_t* is_shown,
                                                             terrane_error** error);

/// Makes the model of an arrangement: blocks of the rounded mesh with the numbers of the exact
/// ones. `rounded` was made from `arrangement` and is conforming. `improved` was made from
/// `rounded`, and the model is then about it; or it is NULL. Free the model with
/// terrane_model_free. Errors: IMPROPER_CONTACT, BAD_OPTION (the handles do not belong together, or
/// the column), INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_make_model(const terrane_arrangement* arrangement,
                                            const terrane_mesh* rounded,
                                            const terrane_improved* improved,
                                            const terrane_model_options* options,
                                            const terrane_run* run, terrane_model** out,
                                            terrane_error** error);
/// Frees a model.
TERRANE_API void terrane_model_free(terrane_model* model);
/// Returns the mesh of the model, a part of it.
TERRANE_API const terrane_mesh* terrane_model_mesh(const terrane_model* model);
/// Returns the volumes of the mesh by the numbers of the exact blocks, a part of the model.
TERRANE_API const terrane_volumes* terrane_model_volumes(const terrane_model* model);
/// Returns the structure by the same numbers, a part of the model.
TERRANE_API const terrane_structure* terrane_model_structure(const terrane_model* model);
/// Returns, per exact block, the double nearest to its volume before rounding, in cubic units; [0]
/// is infinite, as the outside has no end.
TERRANE_API const double* terrane_model_exact_volumes(const terrane_model* model, size_t* count);
/// Returns the volume of all exact blocks together, likewise; 0 without a handle.
TERRANE_API double terrane_model_total_volume(const terrane_model* model);
/// Returns the number of exact blocks that were too thin for doubles.
TERRANE_API size_t terrane_model_lost(const terrane_model* model);
/// Returns the number of blocks that rounding made; they come last.
TERRANE_API size_t terrane_model_made(const terrane_model* model);
/// Returns the structure with leaks as JSON text, as `terrane volume` writes model.json;
/// docs/reference/model.md describes its keys. Free it with terrane_text_free. Errors:
/// BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_model_to_json(const terrane_model* model, char** text,
                                               terrane_error** error);
/// Writes a model to a folder, which appears when it is complete, as `terrane volume` does:
/// model.json, result.vtp, and each block and interface in a format. NULL or "auto" is "vtp", with one
/// file for all blocks and one for all interfaces if they are more than 1000. The folder must not
/// exist, or be empty. Errors: UNKNOWN_FORMAT, CANNOT_OPEN, those of writing, INTERRUPTED,
/// OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_model_write(const terrane_model* model, const char* folder,
                                             const char* part_format, const terrane_run* run,
                                             terrane_error** error);
/// Frees a text that a function handed out.
TERRANE_API void terrane_text_free(char* text);

#ifdef __cplusplus
}
#endif
