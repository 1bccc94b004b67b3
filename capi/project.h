// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The whole chain from a project: files, holes, layers, volume of interest, sealing, arrangement,
// rounding, improvement, blocks and tetrahedra.
#pragma once

#include <terrane/capi/base.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/model.h>
#include <terrane/capi/surfaces.h>
#include <terrane/capi/tetrahedra.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The model of a project, and the results of its stages.
typedef struct terrane_built terrane_built;

/// Builds the model of a project file, as `terrane build` does, without writing files. Free the
/// result with terrane_built_free. Errors: those of reading and of the stages; BAD_OPTION with
/// "project.json: key"; IMPROPER_CONTACT where the rounded mesh is not conforming.
TERRANE_API terrane_code terrane_build_file(const char* path, const terrane_run* run,
                                            terrane_built** out, terrane_error** error);
/// Builds the model of a project given as JSON text, whose relative paths start at `folder` (NULL:
/// the current one). With `surfaces` not NULL, these stand for the files of the project, in their
/// order: the names and roles that the project gives count, and each entry of the project takes one
/// surface. Errors: as terrane_build_file.
TERRANE_API terrane_code terrane_build(const char* json, const char* folder,
                                       const terrane_surfaces* surfaces, const terrane_run* run,
                                       terrane_built** out, terrane_error** error);
/// Frees a built project.
TERRANE_API void terrane_built_free(terrane_built* built);
/// Returns the model, a part of the handle.
TERRANE_API const terrane_model* terrane_built_model(const terrane_built* built);
/// Returns the tetrahedra, a part of the handle; NULL where the project asks for none.
TERRANE_API const terrane_tetrahedra* terrane_built_tetrahedra(const terrane_built* built);
/// Returns the surfaces that were arranged, filled, ordered, extended and sealed as the project
/// asks, with the boundary of the volume of interest as the last; a part of the handle.
TERRANE_API const terrane_surfaces* terrane_built_surfaces(const terrane_built* built);
/// Returns the arrangement, a part of the handle.
TERRANE_API const terrane_arrangement* terrane_built_arrangement(const terrane_built* built);

#ifdef __cplusplus
}
#endif
