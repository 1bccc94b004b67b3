// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces from arrays and files, boundaries, and the check of triangles.
#include "support.h"

#include <stdlib.h>
#include <string.h>

static void test_arrays(void) {
    terrane_surfaces *s = small_surfaces(), *copy = NULL;
    CHECK(terrane_surfaces_count(s) == 3);
    CHECK(same_text(terrane_surfaces_name(s, 1), "fault"));
    CHECK(terrane_surfaces_role(s, 1) == TERRANE_ROLE_FAULT);
    size_t n = 0;
    const double* const v = terrane_surfaces_vertices(s, 0, &n);
    CHECK(n == 4 && v[3] == 4 && v[4] == 0 && v[10] == 4);
    const uint32_t* const t = terrane_surfaces_triangles(s, 0, &n);
    CHECK(n == 2 && t[0] == 0 && t[4] == 2 && t[5] == 3);
    WORKS(terrane_surfaces_label(s, 1, "F2", TERRANE_ROLE_HORIZON, &error));
    CHECK(same_text(terrane_surfaces_name(s, 1), "F2"));
    CHECK(terrane_surfaces_role(s, 1) == TERRANE_ROLE_HORIZON);

    WORKS(terrane_surfaces_new(&copy, &error));
    WORKS(terrane_surfaces_append(copy, s, &error));
    WORKS(terrane_surfaces_append(copy, copy, &error)); // to itself
    CHECK(terrane_surfaces_count(copy) == 6);
    WORKS(terrane_surfaces_add(copy, NULL, TERRANE_ROLE_UNKNOWN, NULL, 0, NULL, 0, &error));
    CHECK(same_text(terrane_surfaces_name(copy, 6), ""));
    terrane_surfaces_vertices(copy, 6, &n);
    CHECK(n == 0);
    terrane_surfaces_free(s); // the copies stay
    CHECK(same_text(terrane_surfaces_name(copy, 4), "F2"));
    terrane_surfaces_free(copy);
}

/// What the program warns of is a text.
static void test_doubts(void) {
    const double flat[] = {0, 0, 0, 4, 0, 0, 0, 4, 0};
    const uint32_t triangle[] = {0, 1, 2};
    terrane_surfaces* s = NULL;
    char* text = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    WORKS(terrane_surfaces_add(s, "top", TERRANE_ROLE_HORIZON, flat, 3, triangle, 1, &error));
    WORKS(terrane_surfaces_doubts(s, 0, &text, &error));
    CHECK(same_text(text, "[]"));
    terrane_text_free(text);
    WORKS(terrane_surfaces_doubts(s, 1, &text, &error));
    CHECK(strstr(text, "\"about\":\"no_top\",\"surfaces\":[\"top\"]") != NULL);
    terrane_text_free(text);
    FAILS(TERRANE_BAD_ARGUMENT, terrane_surfaces_doubts(NULL, 0, &text, &error));
    CHECK(text == NULL);
    FAILS(TERRANE_BAD_ARGUMENT, terrane_surfaces_doubts(s, 0, NULL, &error));
    terrane_surfaces_free(s);
}

/// An array need not begin where a double may.
static void test_unaligned(void) {
    const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0.25};
    const uint32_t triangle[] = {0, 1, 2};
    char bytes[sizeof vertices + 1], more[sizeof triangle + 1];
    memcpy(bytes + 1, vertices, sizeof vertices);
    memcpy(more + 1, triangle, sizeof triangle);
    const void *at = bytes + 1, *indices = more + 1; // what a foreign array can be
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    WORKS(terrane_surfaces_add(s, "odd", TERRANE_ROLE_UNKNOWN, at, 3, indices, 1, &error));
    CHECK(terrane_surfaces_vertices(s, 0, NULL)[8] == 0.25);
    CHECK(terrane_surfaces_triangles(s, 0, NULL)[2] == 2);
    terrane_surfaces_free(s);
}

static void test_files(void) {
    terrane_surfaces *s = NULL, *again = NULL;
    terrane_read_options reading;
    terrane_write_options writing;
    CHECK(terrane_read_options_init(&reading, sizeof reading) == TERRANE_OK);
    CHECK(terrane_write_options_init(&writing, sizeof writing) == TERRANE_OK);
    CHECK(reading.struct_size == sizeof reading && reading.format == NULL && writing.compress == 1);
    WORKS(terrane_surfaces_new(&s, &error));
    WORKS(terrane_surfaces_new(&again, &error));
    WORKS(terrane_surfaces_read(s, path_in(data_folder, "top.ts"), NULL, &error));
    WORKS(terrane_surfaces_read(s, path_in(data_folder, "fault.ts"), &reading, &error));
    CHECK(terrane_surfaces_count(s) == 2 && same_text(terrane_surfaces_name(s, 0), "top"));

    size_t size = 0;
    char* const text = contents_of(path_in(data_folder, "top.ts"), &size);
    reading.format = "ts";
    WORKS(terrane_surfaces_parse(again, text, size, "memory", &reading, &error));
    size_t n1 = 0, n2 = 0;
    const double* const v1 = terrane_surfaces_vertices(s, 0, &n1);
    const double* v2 = terrane_surfaces_vertices(again, 0, &n2);
    CHECK(n1 > 100 && n1 == n2 && memcmp(v1, v2, n1 * 3 * sizeof(double)) == 0);
    FAILS(TERRANE_BAD_SYNTAX,
          terrane_surfaces_parse(again, text, size / 2, "half.ts", &reading, &error));
    free(text);

    writing.format = "obj";
    WORKS(terrane_surfaces_write(s, path_in(work_folder, "surfaces.dat"), &writing, &error));
    reading.format = "obj";
    WORKS(terrane_surfaces_read(again, path_in(work_folder, "surfaces.dat"), &reading, &error));
    CHECK(terrane_surfaces_count(again) == 3);
    v2 = terrane_surfaces_vertices(again, 1, &n2);
    CHECK(n1 == n2 &&
          memcmp(terrane_surfaces_vertices(s, 0, NULL), v2, n1 * 3 * sizeof(double)) == 0);
    terrane_surfaces_free(again);
    terrane_surfaces_free(s);
}

static void test_boundaries(void) {
    const double low[] = {0, 0, 0}, high[] = {1, 2, 3}, corners[] = {0, 0, 4, 0, 0, 3};
    terrane_surfaces *box = NULL, *prism = NULL, *closed = NULL;
    WORKS(terrane_box_boundary(low, high, &box, &error));
    CHECK(terrane_surfaces_count(box) == 6);
    CHECK(same_text(terrane_surfaces_name(box, 0), "boundary top"));
    CHECK(terrane_surfaces_role(box, 5) == TERRANE_ROLE_BOUNDARY);
    WORKS(terrane_polygon_boundary(corners, 3, 0, -1, &prism, &error));
    CHECK(terrane_surfaces_count(prism) == 5);
    WORKS(terrane_closed_boundary(prism, NULL, &closed, &error));
    CHECK(terrane_surfaces_count(closed) > 0);
    CHECK(terrane_surfaces_role(closed, 0) == TERRANE_ROLE_BOUNDARY);
    terrane_surfaces_free(closed);
    terrane_surfaces_free(box);
    terrane_surfaces_free(prism);

    terrane_rotated_box rotated = {{0, 0, 0}, {2, 4, 6}, 30, 10, 0, 0, 0};
    WORKS(terrane_rotated_box_boundary(&rotated, &box, &error));
    CHECK(terrane_surfaces_count(box) == 6);
    terrane_surfaces_free(box);
    rotated.lengths[1] = -1;
    FAILS(TERRANE_BAD_OPTION, terrane_rotated_box_boundary(&rotated, &box, &error));
    FAILS(TERRANE_BAD_OPTION, terrane_box_boundary(high, low, &box, &error));
    FAILS(TERRANE_BAD_OPTION, terrane_polygon_boundary(corners, 2, 0, 1, &box, &error));
    terrane_surfaces* const open = small_surfaces();
    FAILS(TERRANE_NOT_CLOSED, terrane_closed_boundary(open, NULL, &box, &error));
    CHECK(box == NULL);
    terrane_surfaces_free(open);
}

static void test_check(void) {
    terrane_surfaces* const s = small_surfaces();
    const double flat[] = {20, 0, 0, 21, 0, 0, 22, 0, 0, 20, 1, 0, 20, -1, 0, 20, 0, 5};
    const uint32_t bad[] = {0, 1, 2, 0, 1, 3, 0, 3, 1, 0, 1, 4, 0, 1, 5};
    WORKS(terrane_surfaces_add(s, "bad", TERRANE_ROLE_UNKNOWN, flat, 6, bad, 5, &error));
    terrane_check_report* report = NULL;
    WORKS(terrane_check(s, NULL, &report, &error));
    terrane_check_summary summary;
    CHECK(terrane_check_get_summary(report, &summary, sizeof summary) == TERRANE_OK);
    CHECK(summary.surfaces == 4 && summary.triangles == 12 && summary.is_clean == 0);
    size_t n = 0;
    const terrane_contact* const contacts = terrane_check_contacts(report, &n);
    CHECK(n == 2 && contacts[0].triangles[0] == 0 && contacts[0].triangles[1] == 2);
    CHECK(same_text(terrane_contact_kind_name(contacts[0].kind), "crossing"));
    CHECK(contacts[0].place[0] == 1 && contacts[0].place[2] == 0);
    const uint32_t* list = terrane_check_degenerate(report, &n);
    CHECK(n == 1 && list[0] == 7);
    list = terrane_check_repeated(report, &n);
    CHECK(n == 1 && list[0] == 9 && list[1] == 8);
    terrane_check_shared(report, &n);
    CHECK(n == 0);
    const double* const edges = terrane_check_non_manifold_edges(report, &n);
    CHECK(n == 1 && edges[0] == 20 && edges[3] == 21);
    terrane_check_free(report);

    WORKS(
        terrane_surfaces_append(s, s, &error)); // the same triangles in other surfaces are no flaw
    WORKS(terrane_check(s, NULL, &report, &error));
    list = terrane_check_shared(report, &n);
    CHECK(n >= 7 && list[1] < list[0]);
    terrane_check_free(report);
    terrane_surfaces_free(s);
}

void test_surfaces(void) {
    test_arrays();
    test_doubts();
    test_unaligned();
    test_files();
    test_boundaries();
    test_check();
}
