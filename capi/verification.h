// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The independent verifier, which judges results with rational numbers; and the judgement of any mesh by
// its inputs.
#pragma once

#include <terrane/capi/arrangement.h>
#include <terrane/capi/base.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/surfaces.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The verdict of the verifier.
typedef struct terrane_verdict terrane_verdict;

/// Options of terrane_verify_certificate.
typedef struct terrane_verify_options {
    size_t struct_size;        ///< sizeof(terrane_verify_options)
    const char* const* inputs; ///< the input files in the order of the certificate; NULL: next to
                               ///< it
    size_t input_count;        ///< number of them
    terrane_read_options reading; ///< how they are read; terrane_verify_options_init sets it, too
    double max_deviation;         ///< the largest that is accepted; < 0: the default
    double max_change;            ///< the largest limit of a change that is accepted; < 0: the
                                  ///< default
    const char* folder;           ///< the folder that has the files which the certificate names;
                                  ///< NULL: its own, without links
    double time;                  ///< processor seconds that it may take; TIMED_OUT beyond
    double memory;                ///< bytes that it may take; OUT_OF_MEMORY beyond
} terrane_verify_options;

/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_verify_options_init(terrane_verify_options* options,
                                                     size_t struct_size);

/// Judges whether an arrangement is that of the surfaces: all its points, triangles, parents and
/// edges. Free the verdict with terrane_verdict_free. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_verify_arrangement(const terrane_surfaces* surfaces,
                                                    const terrane_arrangement* arrangement,
                                                    terrane_verdict** out, terrane_error** error);
/// Judges whether a mesh of doubles is conforming. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_verify_mesh(const terrane_mesh* mesh, terrane_verdict** out,
                                             terrane_error** error);
/// Judges a certificate from the input files, and the output files that it names. Files that it names
/// are opened in that folder only. An output file that is missing, or of a
/// format that the verifier does not write, is a violation. Errors: CANNOT_OPEN, BAD_SYNTAX,
/// BAD_OPTION (the number of input files), those of reading, TIMED_OUT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_verify_certificate(const char* path,
                                                    const terrane_verify_options* options,
                                                    terrane_verdict** out, terrane_error** error);
/// Frees a verdict.
TERRANE_API void terrane_verdict_free(terrane_verdict* verdict);
/// Returns 1 if there is no violation, else 0.
TERRANE_API int terrane_verdict_is_valid(const terrane_verdict* verdict);
/// Returns the number of violations, sorted by rule.
TERRANE_API size_t terrane_verdict_count(const terrane_verdict* verdict);
/// Returns the rule that a violation breaks, "R5"; "output" for a file that could not be judged.
TERRANE_API const char* terrane_verdict_rule(const terrane_verdict* verdict, size_t violation);
/// Returns the sentence of a violation.
TERRANE_API const char* terrane_verdict_sentence(const terrane_verdict* verdict, size_t violation);
/// Returns the elements that a violation is about; docs/reference/certificate.md says of what kind.
TERRANE_API const uint32_t* terrane_verdict_elements(const terrane_verdict* verdict,
                                                     size_t violation, size_t* count);

/// The operations that terrane_judge knows; NONE: the mesh is an arrangement.
typedef int32_t terrane_operation;
enum {
    TERRANE_OPERATION_NONE = 0,                ///< the arrangement of all inputs
    TERRANE_OPERATION_UNION = 1,               ///< inside any operand
    TERRANE_OPERATION_INTERSECTION = 2,        ///< inside all
    TERRANE_OPERATION_DIFFERENCE = 3,          ///< inside the first and no other
    TERRANE_OPERATION_SYMMETRIC_DIFFERENCE = 4 ///< inside an odd number
};

/// What a judgement says of a property.
typedef int32_t terrane_property_verdict;
enum {
    TERRANE_PROPERTY_HOLDS = 0,     ///< it was judged and holds
    TERRANE_PROPERTY_FAILS = 1,     ///< it was judged and fails
    TERRANE_PROPERTY_NOT_JUDGED = 2 ///< nothing is known
};

/// The judgement of a mesh.
typedef struct terrane_mesh_judgement terrane_mesh_judgement;

/// Options of terrane_judge.
typedef struct terrane_judge_options {
    size_t struct_size;          ///< sizeof(terrane_judge_options)
    double spacings;             ///< how far points may be rounded, in spacings of doubles
    size_t most_flaws;           ///< flaws that are listed for each property
    terrane_operation operation; ///< what the mesh is of the inputs
    int32_t reserved;            ///< 0
} terrane_judge_options;

/// A property that was judged. Texts live as long as the judgement.
typedef struct terrane_property {
    const char* name;                 ///< "conforming", "coverage", ...
    const char* sentence;             ///< what was found
    double size;                      ///< largest move, sum of areas, ... as the sentence says
    size_t count;                     ///< number of flaws
    size_t listed;                    ///< number of those that are listed
    terrane_property_verdict verdict; ///< whether it holds
    int32_t reserved;                 ///< 0
} terrane_property;

/// A place where a property fails. Texts and arrays live as long as the judgement.
typedef struct terrane_property_flaw {
    const char* sentence;      ///< what is wrong
    double place[3];           ///< where
    double size;               ///< area, distance or angle; or 0
    const uint32_t* triangles; ///< of the mesh, counted through its surfaces
    size_t triangle_count;     ///< number of them
} terrane_property_flaw;

/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_judge_options_init(terrane_judge_options* options,
                                                    size_t struct_size);

/// Judges a mesh, whatever program made it, by the surfaces that it was made from; without inputs
/// (NULL), its triangles alone. Each surface is one operand of an operation. Free the judgement with
/// terrane_mesh_judgement_free. Errors: BAD_ARGUMENT, BAD_OPTION, NOT_CLOSED, INTERRUPTED,
/// OUT_OF_MEMORY, INTERNAL.
TERRANE_API terrane_code terrane_judge(const terrane_surfaces* output,
                                       const terrane_surfaces* inputs,
                                       const terrane_judge_options* options, const terrane_run* run,
                                       terrane_mesh_judgement** out, terrane_error** error);
/// Judges tetrahedra, whatever program made them, by the surfaces that they fill. `vertices` has 3 numbers for
/// each of `vertex_count`, `tetrahedra` 4 indices for each of `tetrahedron_count`, and `labels` the number of
/// its block for each; NULL: none. In flaws, tetrahedra stand for triangles. Free the judgement with
/// terrane_mesh_judgement_free. Errors: BAD_ARGUMENT, BAD_NUMBER, BAD_INDEX, BAD_OPTION, INTERRUPTED,
/// OUT_OF_MEMORY, INTERNAL.
TERRANE_API terrane_code terrane_judge_tetrahedra(
    const double* vertices, size_t vertex_count, const uint32_t* tetrahedra,
    size_t tetrahedron_count, const uint32_t* labels, const terrane_surfaces* inputs,
    const terrane_judge_options* options, const terrane_run* run, terrane_mesh_judgement** out,
    terrane_error** error);
/// Frees a judgement.
TERRANE_API void terrane_mesh_judgement_free(terrane_mesh_judgement* judgement);
/// Returns 1 if all properties hold, else 0.
TERRANE_API int terrane_mesh_judgement_holds(const terrane_mesh_judgement* judgement);
/// Returns the number of properties.
TERRANE_API size_t terrane_mesh_judgement_count(const terrane_mesh_judgement* judgement);
/// Writes a property to *property. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_mesh_judgement_property(const terrane_mesh_judgement* judgement,
                                                         size_t number, terrane_property* property,
                                                         size_t struct_size);
/// Writes a flaw of a property to *flaw. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_mesh_judgement_flaw(const terrane_mesh_judgement* judgement,
                                                     size_t number, size_t flaw_number,
                                                     terrane_property_flaw* flaw,
                                                     size_t struct_size);

#ifdef __cplusplus
}
#endif
