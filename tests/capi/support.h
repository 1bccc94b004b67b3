// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Functions that the tests of the C interface share: checks that count failures, and small
// surfaces.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include <terrane/terrane.h>

/// The error of the last call.
extern terrane_error* error;
/// The folder docs/data of the sources, and a folder that tests may write to.
extern const char* data_folder;
extern const char* work_folder;

/// Returns the number of checks that failed.
int failures(void);

int check(int holds, const char* what, const char* file, int line);
int works(terrane_code code, const char* what, const char* file, int line);
int fails(terrane_code wanted, terrane_code code, const char* what, const char* file, int line);

/// Counts a failure unless the expression holds.
#define CHECK(expression) check((expression) ? 1 : 0, #expression, __FILE__, __LINE__)
/// Counts a failure unless a call with the argument &error returns TERRANE_OK.
#define WORKS(call) works((call), #call, __FILE__, __LINE__)
/// Counts a failure unless a call with the argument &error returns this code, with an error that
/// says why.
#define FAILS(code, call) fails((code), (call), #call, __FILE__, __LINE__)

int same_text(const char* a, const char* b);
int contains(const char* text, const char* part);
/// Returns the path of a file in a folder; valid until the fourth call after this one.
const char* path_in(const char* folder, const char* name);
/// Returns the contents of a file, to be freed, with its size; NULL if it can't be read.
char* contents_of(const char* path, size_t* size);

/// Returns three surfaces: a horizon of two triangles, a fault that cuts it, and a tetrahedron of
/// volume 9/2 next to them.
terrane_surfaces* small_surfaces(void);
/// Appends a square in the plane z with n by n cells from (0, 0) to (size, size), without the cells
/// in the middle if `hole`.
void add_square(terrane_surfaces* surfaces, const char* name, terrane_role role, double z,
                double size, unsigned n, int hole);
/// Returns two horizons and a fault in a box: surfaces 0 to 2, and the six faces of the box.
terrane_surfaces* boxed_surfaces(uint32_t boundary[6]);

void test_basics(void);
void test_runs(void);
void test_surfaces(void);
void test_arrangement(void);
void test_sealing(void);
void test_model(void);
void test_reconstruction(void);
void test_tetrahedra(void);
void test_verification(void);
void test_certificate(void);
void test_project(void);
void test_arguments(void);
void test_forged_numbers(void);
