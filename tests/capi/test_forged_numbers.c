// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrays of any numbers: NaN, infinities, indices that are too large, and random surfaces with all
// of these.
#include "support.h"

#include <math.h>
#include <stdlib.h>

static uint64_t state = 1;

/// Returns the next of a fixed series of numbers that look random (xorshift64*).
static uint32_t next_number(uint32_t limit) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (uint32_t)((state * 2685821657736338717U) >> 33) % limit;
}

static void test_places(void) {
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    double v[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    uint32_t t[] = {0, 1, 2};
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; ++i) {
        v[5] = bad[i];
        CHECK(terrane_surfaces_add(s, "top", 0, v, 3, t, 1, &error) == TERRANE_BAD_NUMBER);
        CHECK(same_text(terrane_error_place(error), "surface top, vertex 1"));
        terrane_error_free(error);
    }
    v[5] = 0;
    t[2] = 3;
    CHECK(terrane_surfaces_add(s, "top", 0, v, 3, t, 1, &error) == TERRANE_BAD_INDEX);
    CHECK(same_text(terrane_error_place(error), "surface top, triangle 0"));
    terrane_error_free(error);
    t[2] = UINT32_MAX;
    FAILS(TERRANE_BAD_INDEX, terrane_surfaces_add(s, "top", 0, v, 3, t, 1, &error));
    CHECK(terrane_surfaces_count(s) == 0); // nothing was added
    FAILS(TERRANE_OUT_OF_MEMORY, terrane_surfaces_add(s, "top", 0, v, SIZE_MAX / 8, t, 1, &error));
    const double low[] = {NAN, 0, 0}, high[] = {1, 1, INFINITY}, good[] = {0, 0, 0};
    terrane_surfaces* box = NULL;
    CHECK(terrane_box_boundary(low, high, &box, &error) != TERRANE_OK);
    terrane_error_free(error);
    CHECK(terrane_box_boundary(good, high, &box, &error) != TERRANE_OK);
    terrane_error_free(error);
    error = NULL;
    terrane_surfaces_free(s);
}

/// Options that are no numbers are refused, or make no difference.
static void test_options(void) {
    terrane_surfaces* const s = small_surfaces();
    terrane_arrangement* a = NULL;
    terrane_mesh *mesh = NULL, *none = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    terrane_round_options rounding;
    terrane_round_options_init(&rounding, sizeof rounding);
    rounding.max_move = NAN;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_round(a, &rounding, NULL, &none, &error));
    const size_t first = offsetof(terrane_improve_options, edge_length), size = sizeof(double);
    for (size_t at = first; at < offsetof(terrane_improve_options, passes); at += size) {
        if (at >= offsetof(terrane_improve_options, edge_length_of) &&
            at < offsetof(terrane_improve_options, max_deviation))
            continue; // an array
        terrane_improve_options options;
        terrane_improved* improved = NULL;
        terrane_improve_options_init(&options, sizeof options);
        *(double*)(void*)((char*)&options + at) = NAN;
        CHECK(terrane_improve(mesh, &options, NULL, &improved, &error) == TERRANE_BAD_OPTION);
        terrane_error_free(error);
        CHECK(improved == NULL);
    }
    terrane_seal_options sealing;
    terrane_sealed* sealed = NULL;
    terrane_seal_options_init(&sealing, sizeof sealing);
    sealing.distance = NAN;
    FAILS(TERRANE_BAD_OPTION, terrane_seal(s, &sealing, NULL, &sealed, &error));
    const terrane_seal_rule rule = {0, TERRANE_NONE, NAN};
    sealing.distance = 1;
    sealing.rules = &rule;
    sealing.rule_count = 1;
    FAILS(TERRANE_BAD_OPTION, terrane_seal(s, &sealing, NULL, &sealed, &error));
    terrane_arrangement* merged = NULL;
    FAILS(TERRANE_BAD_OPTION, terrane_merge_small_blocks(a, NAN, NULL, &merged, NULL, &error));
    double distance = 0;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_choose_seal(a, s, NAN, NULL, &distance, &error));
    const uint32_t boundary[] = {2};
    terrane_extended* extended = NULL;
    FAILS(TERRANE_BAD_OPTION,
          terrane_extend_to_boundary(s, boundary, 1, NAN, NULL, &extended, &error));
    const terrane_layer layers[] = {{0, 0, NAN}};
    terrane_layered* layered = NULL;
    FAILS(TERRANE_BAD_OPTION, terrane_stack_layers(s, layers, 1, NULL, NULL, &layered, &error));
    terrane_mesh_free(mesh);
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
}

/// Appends a random surface on a small lattice, where triangles cross, overlap and have no area.
static void add_random(terrane_surfaces* s) {
    const uint32_t vertices = 3 + next_number(9), triangles = 1 + next_number(10);
    double v[36];
    uint32_t t[30];
    for (uint32_t i = 0; i < 3 * vertices; ++i) v[i] = next_number(4);
    for (uint32_t i = 0; i < 3 * triangles; ++i) t[i] = next_number(vertices);
    WORKS(terrane_surfaces_add(s, "random", (terrane_role)next_number(4), v, vertices, t, triangles,
                               &error));
}

static void test_random(void) {
    for (int k = 0; k < 60; ++k) {
        terrane_surfaces* s = NULL;
        terrane_arrangement* a = NULL;
        terrane_mesh* mesh = NULL;
        terrane_verdict* verdict = NULL;
        terrane_model* model = NULL;
        WORKS(terrane_surfaces_new(&s, &error));
        for (uint32_t i = 0, n = 1 + next_number(3); i < n; ++i) add_random(s);
        WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
        WORKS(terrane_verify_arrangement(s, a, &verdict, &error));
        CHECK(terrane_verdict_is_valid(verdict) == 1);
        WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
        if (terrane_mesh_is_conforming(mesh)) {
            size_t n = 0;
            WORKS(terrane_make_model(a, mesh, NULL, NULL, NULL, &model, &error));
            const double* const exact = terrane_model_exact_volumes(model, &n);
            double sum = 0;
            for (size_t b = 1; b < n; ++b) sum += exact[b];
            CHECK(fabs(sum - terrane_model_total_volume(model)) < 1e-9);
        }
        terrane_model_free(model);
        terrane_verdict_free(verdict);
        terrane_mesh_free(mesh);
        terrane_arrangement_free(a);
        terrane_surfaces_free(s);
    }
}

void test_forged_numbers(void) {
    test_places();
    test_options();
    test_random();
}
