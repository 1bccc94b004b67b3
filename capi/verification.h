// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The independent verifier, which judges results with rational numbers.
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

#ifdef __cplusplus
}
#endif
