// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The C interface of Terrane: all stages of the library for C11 and for all languages that call C.
// docs/how-to/c.md shows how to use it.
//
// (1) Handles are opaque. Each function that makes one says how it is freed; freeing NULL is
//     allowed, and so is freeing a handle by the function of another type, or a `const` handle that
//     a getter returned, which belongs to the handle that it was asked of: they stay as they are.
// (2) Arrays are passed by pointer and length, and copied. Getters return read-only arrays of the
//     handle, which are valid until it is freed or changed; a count may be asked for with each
//     (NULL: not wanted).
// (3) Functions that can fail return a code, which is TERRANE_OK, 0, on success, and have the
//     parameter `error` last: where it is not NULL, *error becomes NULL or an error that
//     terrane_error_free frees. *out becomes NULL on failure.
// (4) Getters of a null handle, or of one of another type, return 0 or NULL; an index that is too
//     large likewise. No C++ exception leaves a function. Freed handles can't be recognised.
// (5) Options are structs whose first member is their size. An init function gives all members
//     their defaults; NULL stands for the defaults. Members are only added at the end, so that
//     programs go on working with later libraries of the same TERRANE_ABI_VERSION. Members `reserved`
//     of what a caller passes are 0.
// (6) Handles that are not changed may be used by several threads at a time. There is no global
//     state.
// (7) Coordinates are x, y, z for each vertex, in the unit of the input. Indices count from 0.
// (8) Texts are UTF-8 and end with NUL. File names are bytes, as the system takes them.
#pragma once

#include <terrane/capi/arrangement.h>
#include <terrane/capi/base.h>
#include <terrane/capi/certificate.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/model.h>
#include <terrane/capi/project.h>
#include <terrane/capi/reconstruction.h>
#include <terrane/capi/sealing.h>
#include <terrane/capi/selection.h>
#include <terrane/capi/structure.h>
#include <terrane/capi/surfaces.h>
#include <terrane/capi/tetrahedra.h>
#include <terrane/capi/verification.h>
