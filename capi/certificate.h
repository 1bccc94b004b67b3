// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates: all that it takes to judge the files of a result from the input files alone, by
// terrane_verify_certificate or by `terrane verify`.
#pragma once

#include <terrane/capi/arrangement.h>
#include <terrane/capi/base.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/model.h>
#include <terrane/capi/reconstruction.h>
#include <terrane/capi/surfaces.h>
#include <terrane/capi/tetrahedra.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A file that surfaces were read from.
typedef struct terrane_input_file {
    const char* path;     ///< where it is; the certificate names it relative to its own folder
    size_t surface_count; ///< number of surfaces that were read from it
} terrane_input_file;

/// A file that holds the result.
typedef struct terrane_output_file {
    const char* path;   ///< where it is; the certificate names it relative to its own folder
    const char* format; ///< "obj", "stl" (binary), "stl-ascii", ...; NULL: by the extension
} terrane_output_file;

/// How many triangles of a surface were given; those that were added to it follow them.
typedef struct terrane_surface_growth {
    uint64_t given;    ///< triangles of the input file
    uint64_t extended; ///< these, and those that terrane_extend_to_boundary added; the rest seals
} terrane_surface_growth;

/// A result, the handles it was made with, and its files. Members that do not belong to it are NULL
/// or 0. The members decide on the kind of the certificate: `holes` makes it one of filled surfaces,
/// `layered` one of layers, `tetrahedra` one of tetrahedra, `model` one of blocks, `improved` one of
/// an improved mesh, and without them it is one of an arrangement; this one says what was cut away
/// where there is a boundary, and what was added where there is growth.
typedef struct terrane_certified {
    size_t struct_size;                 ///< sizeof(terrane_certified)
    const terrane_input_file* inputs;   ///< in the order in which they were read
    size_t input_count;                 ///< number of them
    const terrane_output_file* outputs; ///< the files that hold the result
    size_t output_count;                ///< number of them
    const terrane_surfaces* surfaces;   ///< those of all inputs in order, with what was added to
                                        ///< them, then the boundary of the volume of interest
    const terrane_arrangement* arrangement; ///< of the surfaces, or the part of it that was kept;
                                            ///< not for `holes` and `layered`
    const terrane_mesh* rounded;            ///< what terrane_round made of the arrangement
    const terrane_improved* improved;       ///< what terrane_improve made of the rounded mesh
    const terrane_model* model; ///< of the rounded mesh. Blocks of improved meshes have no
                                ///< certificate
    const char* model_folder; ///< where terrane_model_write put the model, whose files are outputs
                              ///< before the others; not with `tetrahedra`
    const char* part_format;  ///< as terrane_model_write had it
    const terrane_tetrahedra* tetrahedra; ///< of the model
    const terrane_holes* holes;           ///< filled surfaces: a task for each of `surfaces`
    const terrane_layered* layered;       ///< a stack of `surfaces`
    const terrane_layer* layers;          ///< its horizons, as terrane_stack_layers had them
    size_t layer_count;                   ///< number of them
    const terrane_surface_growth* growth; ///< per surface of the inputs; NULL: nothing was added
    size_t growth_count;                  ///< number of them
    size_t boundary_count; ///< number of the last surfaces, which bound the volume of interest; 0:
                           ///< there is none
    const double* corners; ///< of a box or prism: the corners of its polygon in order, x and y of
                           ///< each. NULL: a rotated box, or a volume that `volume_files` hold
    size_t corner_count;   ///< number of them
    double low;            ///< of a box or prism: its lower end; 0 without corners
    double high;           ///< of a box or prism: its upper end
    const terrane_input_file* volume_files; ///< of a volume whose boundary was read from files
    size_t volume_file_count;               ///< number of them
} terrane_certified;

/// Gives a result without anything. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_certified_init(terrane_certified* certified, size_t struct_size);
/// Writes the certificate of a result whose files are written already: their contents are hashed.
/// If it fails, no file is written. A certificate claims and the verifier judges: files or handles
/// of another result make one that is refuted. Errors: BAD_OPTION (the handles or numbers do not
/// belong together, or a name is not UTF-8), IMPROPER_CONTACT (the result is not conforming),
/// UNKNOWN_FORMAT and UNSUPPORTED (no verifier reads this output), CANNOT_OPEN, WRITE_FAILED,
/// INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_write_certificate(const char* path,
                                                   const terrane_certified* certified,
                                                   const terrane_run* run, terrane_error** error);

#ifdef __cplusplus
}
#endif
