// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Null handles, handles of other types, and wrong structs: codes, never a crash.
#include "support.h"

#include <math.h>
#include <string.h>

static void* out = NULL; // of any type
#define REFUSED(call) FAILS(TERRANE_BAD_ARGUMENT, call)

/// A getter of each kind, and stages, for a handle that is null or none. tests/arguments/c_arguments.py calls all functions
/// so, but not under the sanitizers.
static void test_handles(void* h) {
    size_t n = 7;
    terrane_lists lists = {NULL, NULL, 7};
    terrane_rounding_report report;
    char text[4];
    CHECK(terrane_surfaces_count(h) == 0 && terrane_surfaces_name(h, 0) == NULL);
    CHECK(terrane_surfaces_role(h, 0) == TERRANE_ROLE_UNKNOWN);
    CHECK(terrane_arrangement_vertices(h, &n) == NULL && n == 0);
    CHECK(terrane_mesh_parents(h, &lists) == TERRANE_BAD_ARGUMENT && lists.count == 0);
    CHECK(terrane_mesh_get_rounding(h, &report, sizeof report) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_improved_mesh(h) == NULL && isnan(terrane_sealed_left(h)));
    CHECK(terrane_verdict_is_valid(h) == 0 && terrane_verdict_rule(h, 0) == NULL);
    REFUSED(terrane_surfaces_append(h, h, &error));
    REFUSED(terrane_arrange(h, NULL, NULL, (terrane_arrangement**)&out, &error));
    REFUSED(terrane_volumes_exact(h, 0, text, 4, NULL, &error));
    REFUSED(terrane_make_model(h, h, h, NULL, NULL, (terrane_model**)&out, &error));
    REFUSED(terrane_run_request_stop(h, &error));
    CHECK(out == NULL);
}

/// Freeing null, or what is no handle, does nothing.
static void test_frees(void* h) {
    terrane_surfaces_free(h);
    terrane_model_free(h);
    terrane_built_free(h);
    terrane_error_free(h);
}

/// Getters of errors return for other handles what they return for null.
static void test_no_error(const void* h) {
    CHECK(terrane_error_code(h) == TERRANE_OK);
    CHECK(same_text(terrane_error_sentence(h), "") && same_text(terrane_error_place(h), ""));
    CHECK(same_text(terrane_error_message(h), ""));
}

/// A part of a handle is not freed; it goes with the whole.
static void test_parts(const terrane_surfaces* s) {
    terrane_arrangement* a = NULL;
    terrane_mesh* mesh = NULL;
    terrane_improved* improved = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    WORKS(terrane_improve(mesh, NULL, NULL, &improved, &error));
    const terrane_mesh* const part = terrane_improved_mesh(improved);
    size_t count = 0;
    terrane_mesh_free((terrane_mesh*)(uintptr_t)part);
    CHECK(terrane_mesh_triangles(part, &count) != NULL && count > 0);
    terrane_improved_free(improved);
    terrane_mesh_free(mesh);
    terrane_arrangement_free(a);
}

/// Options that would be ignored are refused.
static void test_unused(void) {
    terrane_surfaces* s = NULL;
    terrane_holes* holes = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    add_square(s, "holed", TERRANE_ROLE_HORIZON, 0, 9, 9, 1);
    terrane_fill_task task;
    CHECK(terrane_fill_task_init(&task, sizeof task, 0) == TERRANE_OK);
    task.smoothing = 1; // of radial basis functions
    FAILS(TERRANE_BAD_OPTION, terrane_fill(s, &task, 1, NULL, &holes, &error));
    task.use_rbf = 1;
    task.variogram = "gaussian"; // of kriging
    FAILS(TERRANE_BAD_OPTION, terrane_fill(s, &task, 1, NULL, &holes, &error));
    CHECK(terrane_fill_task_init(&task, sizeof task, 0) == TERRANE_OK);
    task.reserved = 1;
    REFUSED(terrane_fill(s, &task, 1, NULL, &holes, &error));
    terrane_surfaces_free(s);
}

/// Arguments that are wanted but missing: places for results, names of files, arrays.
static void test_missing(const terrane_surfaces* s) {
    terrane_surfaces* list = NULL;
    terrane_arrangement* a = NULL;
    const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
    REFUSED(terrane_run_new(NULL, &error));
    REFUSED(terrane_surfaces_new(NULL, &error));
    REFUSED(terrane_arrange(s, NULL, NULL, NULL, &error));
    REFUSED(terrane_box_boundary(NULL, high, &list, &error));
    REFUSED(terrane_box_boundary(low, NULL, &list, &error));
    REFUSED(terrane_rotated_box_boundary(NULL, &list, &error));
    REFUSED(terrane_polygon_boundary(NULL, 3, 0, 1, &list, &error));
    CHECK(list == NULL);
    WORKS(terrane_surfaces_new(&list, &error));
    REFUSED(terrane_surfaces_add(list, "", 0, NULL, 3, NULL, 0, &error));
    REFUSED(terrane_surfaces_add(list, "", 0, low, 1, NULL, 1, &error));
    REFUSED(terrane_surfaces_add(list, "", 4, low, 1, NULL, 0, &error));
    REFUSED(terrane_surfaces_add(list, "", -1, low, 1, NULL, 0, &error));
    REFUSED(terrane_surfaces_append(list, NULL, &error));
    REFUSED(terrane_surfaces_read(list, NULL, NULL, &error));
    REFUSED(terrane_surfaces_read(list, "-", NULL, &error));
    REFUSED(terrane_surfaces_write(list, "-", NULL, &error));
    REFUSED(terrane_surfaces_parse(list, NULL, 1, "", NULL, &error));
    REFUSED(terrane_surfaces_parse(list, "", 0, "", NULL, &error)); // no format
    REFUSED(terrane_surfaces_label(list, 0, NULL, 0, &error));
    FAILS(TERRANE_BAD_INDEX, terrane_surfaces_label(list, 0, "a", 0, &error));
    CHECK(terrane_surfaces_count(list) == 0);
    WORKS(terrane_arrange(list, NULL, NULL, &a, &error)); // without surfaces
    const uint32_t boundary[] = {0, 0};
    terrane_cut* cut = NULL;
    REFUSED(terrane_cut_to_volume(a, boundary, 1, NULL, &cut, &error)); // no such surface
    REFUSED(terrane_cut_to_volume(a, NULL, 1, NULL, &cut, &error));
    REFUSED(terrane_cut_to_volume(a, NULL, 0, NULL, &cut, &error));
    terrane_arrangement_free(a);
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    REFUSED(terrane_cut_to_volume(a, boundary, 2, NULL, &cut, &error)); // twice
    REFUSED(terrane_merge_small_blocks(a, 1, NULL, NULL, NULL, &error));
    CHECK(terrane_arrangement_parents(a, NULL) == TERRANE_BAD_ARGUMENT);
    terrane_verdict* verdict = NULL;
    REFUSED(terrane_verify_certificate(NULL, NULL, &verdict, &error));
    terrane_built* built = NULL;
    REFUSED(terrane_build(NULL, NULL, NULL, NULL, &built, &error));
    REFUSED(terrane_build_file(NULL, NULL, &built, &error));
    terrane_arrangement* none = NULL;
    REFUSED(terrane_arrange(s, NULL, (const terrane_run*)(const void*)a, &none, &error)); // no run
    CHECK(none == NULL);
    terrane_arrangement_free(a);
    terrane_surfaces_free(list);
}

/// Structs whose size is that of no version of them.
static void test_sizes(const terrane_surfaces* s) {
    terrane_arrange_options options;
    terrane_arrangement* a = NULL;
    CHECK(terrane_arrange_options_init(NULL, sizeof options) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_arrange_options_init(&options, sizeof options + 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_arrange_options_init(&options, 0) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_round_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_improve_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_seal_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_layer_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_model_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_tetrahedra_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_verify_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_fill_task_init(NULL, 8, 0) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_read_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_write_options_init(NULL, 8) == TERRANE_BAD_ARGUMENT);

    memset(&options, 0, sizeof options); // not initialised: a size of 0
    REFUSED(terrane_arrange(s, &options, NULL, &a, &error));
    CHECK(a == NULL);

    struct {
        terrane_improve_options options;
        char beyond[8];
    } known;
    memset(&known, 0x5a, sizeof known);
    const size_t older =
        offsetof(terrane_improve_options, curve_length); // as an older program knows it
    CHECK(terrane_improve_options_init(&known.options, older) == TERRANE_OK);
    CHECK(known.options.struct_size == older);
    const char* const bytes = (const char*)&known;
    for (size_t i = older; i < sizeof known; ++i)
        CHECK(bytes[i] == 0x5a); // nothing is written beyond
    terrane_mesh* mesh = NULL;
    terrane_improved* improved = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    WORKS(terrane_improve(mesh, &known.options, NULL, &improved, &error)); // nor read
    terrane_improved_free(improved);

    terrane_rounding_report report;
    CHECK(terrane_mesh_get_rounding(mesh, NULL, sizeof report) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_mesh_get_rounding(mesh, &report, sizeof report + 1) == TERRANE_BAD_ARGUMENT);
    report.rounds = 77;
    CHECK(terrane_mesh_get_rounding(mesh, &report, sizeof report.is_conforming) == TERRANE_OK);
    CHECK(report.is_conforming == 1 && report.rounds == 77);
    terrane_quality quality;
    REFUSED(terrane_measure_quality(mesh, NULL, NULL, sizeof quality, &error));
    REFUSED(terrane_measure_quality(mesh, NULL, &quality, sizeof quality + 1, &error));
    CHECK(terrane_surfaces_vertices(s, 99, NULL) == NULL);
    terrane_mesh_free(mesh);
    terrane_arrangement_free(a);
}

void test_arguments(void) {
    terrane_surfaces* const s = small_surfaces();
    terrane_arrangement* a = NULL;
    terrane_run* run = NULL;
    terrane_check_report* report = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_run_new(&run, &error));
    WORKS(terrane_check(s, NULL, &report, &error));
    test_handles(NULL);
    test_frees(NULL);
    const uint64_t strange[4] = {1, 2, 3, 4}; // no handle at all
    test_handles((void*)strange);
    test_frees((void*)strange);
    test_no_error(NULL);
    test_no_error(strange);
    test_no_error(s);
    terrane_error_free((terrane_error*)(void*)a); // of another type: it stays
    test_parts(s);
    test_unused();
    test_missing(s);
    test_sizes(s);
    CHECK(terrane_check_contacts((const terrane_check_report*)(const void*)s, NULL) == NULL);
    CHECK(terrane_arrangement_triangles((const terrane_arrangement*)(const void*)run, NULL) ==
          NULL);
    terrane_mesh_free((terrane_mesh*)(void*)a); // of another type: it stays
    CHECK(terrane_arrangement_triangles(a, NULL) != NULL);
    terrane_check_free(report);
    terrane_run_free(run);
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
}
