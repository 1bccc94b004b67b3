// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sealing, extension to a boundary, and small blocks.
#include "support.h"

#include <math.h>

/// Returns a horizon and a fault that stops 0.01 above it, or goes through.
static terrane_surfaces* with_gap(double lowest) {
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    add_square(s, "horizon", TERRANE_ROLE_HORIZON, 0, 10, 4, 0);
    const double fault[] = {5.1, 1, lowest, 5.1, 9, lowest, 5.1, 9, 6, 5.1, 1, 6};
    const uint32_t square[] = {0, 1, 2, 0, 2, 3};
    WORKS(terrane_surfaces_add(s, "F1", TERRANE_ROLE_FAULT, fault, 4, square, 2, &error));
    return s;
}

static void test_gaps(void) {
    terrane_surfaces* const s = with_gap(0.01);
    terrane_seal_options options;
    CHECK(terrane_seal_options_init(&options, sizeof options) == TERRANE_OK);
    options.distance = 0.1;
    terrane_sealed* sealed = NULL;
    WORKS(terrane_seal(s, &options, NULL, &sealed, &error));
    size_t n = 0, triangles = 0, edges = 0;
    const terrane_closed_gap* const closed = terrane_sealed_closed(sealed, &n);
    CHECK(n >= 1 && closed[0].from == 1 && closed[0].to == 0);
    CHECK(n >= 1 && fabs(closed[0].width - 0.01) < 1e-9);
    const terrane_seal_change* const changes = terrane_sealed_changes(sealed, &n);
    CHECK(n >= 1 && changes[0].surface == 1 && changes[0].is_trimmed == 0);
    terrane_surfaces_triangles(terrane_sealed_surfaces(sealed), 1, &triangles);
    CHECK(triangles > 2); // a strip was added
    terrane_arrangement_intersection_edges(terrane_sealed_arrangement(sealed), &edges);
    CHECK(edges > 0);
    terrane_sealed_open(sealed, &n);
    CHECK(terrane_sealed_left(sealed) >= 0);
    terrane_sealed_free(sealed);

    const terrane_seal_rule never = {1, TERRANE_NONE, 0};
    options.rules = &never;
    options.rule_count = 1;
    WORKS(terrane_seal(s, &options, NULL, &sealed, &error));
    terrane_sealed_closed(sealed, &n);
    CHECK(n == 0 || terrane_sealed_closed(sealed, NULL)[0].from != 1);
    terrane_sealed_free(sealed);
    const terrane_seal_rule wrong = {2, TERRANE_NONE, 1};
    options.rules = &wrong;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_seal(s, &options, NULL, &sealed, &error));
    FAILS(TERRANE_BAD_OPTION, terrane_seal(s, NULL, NULL, &sealed, &error)); // no distance
    terrane_surfaces_free(s);
}

static void test_tolerance(void) {
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    add_square(s, "a", TERRANE_ROLE_UNKNOWN, 0, 10, 4, 0);
    add_square(s, "b", TERRANE_ROLE_UNKNOWN, 0.01, 10, 3, 0);
    terrane_surfaces* joined = NULL;
    size_t left = 7, before = 0, after = 0;
    WORKS(terrane_join_within(s, 0.1, NULL, &left, &joined, &error));
    CHECK(left == 0);
    const double* const a = terrane_surfaces_vertices(joined, 0, &before);
    const double* const b = terrane_surfaces_vertices(joined, 1, &after);
    CHECK(before == after && before >= 4);
    for (size_t i = 0; i < 3 * before && i < 3 * after; ++i) CHECK(a[i] == b[i]);
    terrane_surfaces_free(joined);
    FAILS(TERRANE_BAD_OPTION, terrane_join_within(s, 0, NULL, NULL, &joined, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_join_within(NULL, 1, NULL, NULL, &joined, &error));
    terrane_surfaces_free(s);
}

static void test_choice(void) {
    terrane_surfaces* const s = with_gap(0.01);
    terrane_arrangement* a = NULL;
    double distance = -1, with_length = -1;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_choose_seal(a, s, 0, NULL, &distance, &error));
    CHECK(distance > 0.01 && distance < 1);
    WORKS(terrane_choose_seal(a, NULL, 2.5, NULL, &with_length, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_choose_seal(a, s, 2.5, NULL, &distance, &error));
    CHECK(with_length > 0.01);
    FAILS(TERRANE_BAD_ARGUMENT, terrane_choose_seal(a, NULL, 0, NULL, &distance, &error));
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
}

static void test_extension(void) {
    terrane_surfaces *s = NULL, *box = NULL;
    const double low[] = {-1, -1, -2}, high[] = {11, 11, 2};
    const uint32_t boundary[] = {1, 2, 3, 4, 5, 6};
    WORKS(terrane_surfaces_new(&s, &error));
    add_square(s, "horizon", TERRANE_ROLE_HORIZON, 0, 10, 4, 0);
    WORKS(terrane_box_boundary(low, high, &box, &error));
    WORKS(terrane_surfaces_append(s, box, &error));
    terrane_extended* extended = NULL;
    WORKS(terrane_extend_to_boundary(s, boundary, 6, 3, NULL, &extended, &error));
    size_t n = 0, before = 0, after = 0;
    const terrane_extended_border* const borders = terrane_extended_borders(extended, &n);
    CHECK(n >= 1 && borders[0].surface == 0 && borders[0].reached == 1 && borders[0].length > 9);
    terrane_surfaces_triangles(s, 0, &before);
    terrane_surfaces_triangles(terrane_extended_surfaces(extended), 0, &after);
    CHECK(after > before);

    terrane_arrangement* a = NULL; // the horizon now divides the box
    terrane_cut* cut = NULL;
    terrane_volumes* volumes = NULL;
    WORKS(terrane_arrange(terrane_extended_surfaces(extended), NULL, NULL, &a, &error));
    WORKS(terrane_cut_to_volume(a, boundary, 6, NULL, &cut, &error));
    WORKS(terrane_find_exact_volumes(terrane_cut_arrangement(cut), NULL, &volumes, &error));
    const double* const measures = terrane_volumes_measures(volumes, &n);
    CHECK(n == 3 && terrane_volumes_total(volumes) == 576 && measures[1] == 288 &&
          measures[2] == 288);
    terrane_volumes_free(volumes);

    terrane_arrangement* merged = NULL;
    size_t count = 0;
    WORKS(terrane_merge_small_blocks(terrane_cut_arrangement(cut), 300, NULL, &merged, &count,
                                     &error));
    CHECK(count == 1);
    WORKS(terrane_find_exact_volumes(merged, NULL, &volumes, &error));
    terrane_volumes_measures(volumes, &n);
    CHECK(n == 2);
    terrane_volumes_free(volumes);
    terrane_arrangement_free(merged);
    FAILS(TERRANE_BAD_OPTION, terrane_merge_small_blocks(a, 0, NULL, &merged, NULL, &error));
    terrane_extended* none = NULL;
    FAILS(TERRANE_BAD_OPTION, terrane_extend_to_boundary(s, boundary, 6, 0, NULL, &none, &error));
    CHECK(none == NULL);
    terrane_extended_free(extended);
    terrane_cut_free(cut);
    terrane_arrangement_free(a);
    terrane_surfaces_free(box);
    terrane_surfaces_free(s);
}

void test_sealing(void) {
    test_gaps();
    test_tolerance();
    test_choice();
    test_extension();
}
