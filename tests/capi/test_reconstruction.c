// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Holes, fillings, stacks of layers and selections.
#include "support.h"

#include <math.h>
#include <stdlib.h>

static void check_filling(const terrane_holes* holes, size_t given_triangles) {
    size_t n = 0, vertices = 0, triangles = 0, errors = 0;
    const terrane_hole* const array = terrane_holes_array(holes, &n);
    CHECK(n == 1 && array[0].is_filled == 1 && array[0].surface == 1);
    CHECK(same_text(terrane_holes_refusal(holes, 0), ""));
    CHECK(!same_text(terrane_holes_model(holes, 0), ""));
    CHECK(fabs(array[0].filled_area - 4) < 0.5);
    const terrane_surfaces* const filled = terrane_holes_surfaces(holes);
    CHECK(terrane_surfaces_count(filled) == 1 &&
          same_text(terrane_surfaces_name(filled, 0), "holed"));
    terrane_surfaces_vertices(filled, 0, &vertices);
    terrane_surfaces_triangles(filled, 0, &triangles);
    CHECK(triangles > given_triangles);
    const double* const expected = terrane_holes_expected_errors(holes, 0, &errors);
    CHECK(errors == vertices && expected[0] == 0);
    const int32_t* const of = terrane_holes_of_triangles(holes, 0, &n);
    CHECK(n == triangles && of[0] == 0 && of[triangles - 1] == 1);
    CHECK(terrane_holes_of_triangles(holes, 1, &n) == NULL && n == 0);
}

static void test_holes(void) {
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    add_square(s, "whole", TERRANE_ROLE_HORIZON, 0, 12, 18, 0);
    add_square(s, "holed", TERRANE_ROLE_HORIZON, 3, 6, 12, 1);
    terrane_fill_task task;
    CHECK(terrane_fill_task_init(&task, sizeof task, 1) == TERRANE_OK);
    CHECK(task.surface == 1 && isinf(task.max_area) && isnan(task.smoothing) && task.rings > 0);
    terrane_holes* holes = NULL;
    WORKS(terrane_find_holes(s, &task, 1, NULL, &holes, &error));
    size_t n = 0, given = 0;
    const terrane_hole* const found = terrane_holes_array(holes, &n);
    CHECK(n == 1 && found[0].is_filled == 0 && found[0].is_fault_gap == 0);
    CHECK(found[0].area == 4 && found[0].length == 8 && found[0].centre[0] == 3);
    CHECK(same_text(terrane_holes_model(holes, 0), ""));
    terrane_lists borders;
    CHECK(terrane_holes_borders(holes, &borders) == TERRANE_OK && borders.count == 1);
    CHECK(borders.offsets[1] == 16);
    terrane_holes_free(holes);

    terrane_surfaces_triangles(s, 1, &given);
    WORKS(terrane_fill(s, &task, 1, NULL, &holes, &error));
    check_filling(holes, given);
    terrane_holes_free(holes);
    task.use_rbf = 1;
    WORKS(terrane_fill(s, &task, 1, NULL, &holes, &error));
    check_filling(holes, given);
    terrane_holes_free(holes);
    task.use_rbf = 0;
    task.max_area = 1; // the hole is larger, and stays open
    WORKS(terrane_fill(s, &task, 1, NULL, &holes, &error));
    CHECK(terrane_holes_array(holes, NULL)[0].is_filled == 0);
    terrane_holes_free(holes);

    task.variogram = "cubic";
    FAILS(TERRANE_BAD_OPTION, terrane_fill(s, &task, 1, NULL, &holes, &error));
    task.variogram = "auto";
    task.max_area = NAN;
    FAILS(TERRANE_BAD_OPTION, terrane_fill(s, &task, 1, NULL, &holes, &error));
    task.max_area = 100;
    task.gap_slope = 0;
    FAILS(TERRANE_BAD_OPTION, terrane_find_holes(s, &task, 1, NULL, &holes, &error));
    terrane_fill_task_init(&task, sizeof task, 2);
    FAILS(TERRANE_BAD_INDEX, terrane_fill(s, &task, 1, NULL, &holes, &error));
    terrane_fill_task twice[2];
    terrane_fill_task_init(&twice[0], sizeof task, 1);
    terrane_fill_task_init(&twice[1], sizeof task, 1);
    FAILS(TERRANE_BAD_OPTION, terrane_fill(s, twice, 2, NULL, &holes, &error));
    CHECK(holes == NULL);
    terrane_surfaces_free(s);
}

static void test_layers(void) {
    terrane_surfaces* s = NULL;
    const double tilted[] = {0, 0, -2, 10, 0, 2, 10, 10, 2, 0, 10, -2};
    const uint32_t square[] = {0, 1, 2, 0, 2, 3}, upright[] = {0, 1, 2};
    const double wall[] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
    WORKS(terrane_surfaces_new(&s, &error));
    add_square(s, "hard", TERRANE_ROLE_HORIZON, 0, 10, 2, 0);
    WORKS(terrane_surfaces_add(s, "soft", TERRANE_ROLE_HORIZON, tilted, 4, square, 2, &error));
    WORKS(terrane_surfaces_add(s, "wall", TERRANE_ROLE_HORIZON, wall, 3, upright, 1, &error));
    const terrane_layer order[] = {{0, 0, 2}, {1, 0, 1}, {2, 0, 1}};
    terrane_layered* layered = NULL;
    WORKS(terrane_stack_layers(s, order, 2, NULL, NULL, &layered, &error));
    CHECK(terrane_layered_is_stack(layered) == 1 && terrane_layered_step_width(layered) >= 0);
    size_t n = 0;
    const terrane_layer_report* const reports = terrane_layered_reports(layered, &n);
    CHECK(n == 2 && reports[0].dropped == 0 && reports[1].dropped > 0);
    CHECK(reports[1].surface == 1 && fabs(reports[1].taken_area - 50) < 1e-9);
    const terrane_mesh* const mesh = terrane_layered_mesh(layered);
    CHECK(same_text(terrane_mesh_surface_name(mesh, 1), "soft"));
    const double* const v = terrane_mesh_vertices(mesh, &n);
    for (size_t i = 0; i < n; ++i) CHECK(v[3 * i + 2] <= 0); // the soft one is below everywhere
    terrane_layered_free(layered);

    terrane_layer_options options;
    CHECK(terrane_layer_options_init(&options, sizeof options) == TERRANE_OK);
    options.min_thickness = 0.5;
    WORKS(terrane_stack_layers(s, order, 2, &options, NULL, &layered, &error));
    CHECK(terrane_layered_is_stack(layered) == 1);
    terrane_layered_free(layered);
    options.min_thickness = NAN;
    FAILS(TERRANE_BAD_OPTION, terrane_stack_layers(s, order, 2, &options, NULL, &layered, &error));
    FAILS(TERRANE_UNSUPPORTED, terrane_stack_layers(s, order, 3, NULL, NULL, &layered, &error));
    FAILS(TERRANE_NOTHING_TO_DO, terrane_stack_layers(s, NULL, 0, NULL, NULL, &layered, &error));
    const terrane_layer strange[] = {{7, 0, 1}};
    FAILS(TERRANE_BAD_OPTION, terrane_stack_layers(s, strange, 1, NULL, NULL, &layered, &error));
    CHECK(layered == NULL);
    terrane_surfaces_free(s);
}

static void add_cube(terrane_surfaces* s, const char* name, double low, double high) {
    static const uint32_t faces[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    double corners[24];
    for (unsigned k = 0; k < 24; ++k) corners[k] = (k / 3) >> (k % 3) & 1U ? high : low;
    WORKS(terrane_surfaces_add(s, name, TERRANE_ROLE_BOUNDARY, corners, 8, faces, 12, &error));
}

static void test_selections(void) {
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    add_cube(s, "a", 0, 2);
    add_cube(s, "b", 1, 4);
    const double plane[] = {-9, -9, 1, 9, -9, 1, 9, 9, 1, -9, 9, 1};
    const uint32_t square[] = {0, 1, 2, 0, 2, 3};
    WORKS(terrane_surfaces_add(s, "t", TERRANE_ROLE_HORIZON, plane, 4, square, 2, &error));
    terrane_selected* made = NULL;
    terrane_select_options options;
    CHECK(terrane_select_options_init(&options, sizeof options) == TERRANE_OK);
    options.fractions = 1;
    WORKS(terrane_select(s, "a ^ b", &options, NULL, &made, &error));
    size_t n = 0, triangles = 0;
    const terrane_selected_piece* const pieces = terrane_selected_pieces(made, &n);
    CHECK(n == 2 && pieces[0].volume == 7 && pieces[1].volume == 26);
    const uint32_t* const piece_of = terrane_selected_piece_of(made, &n);
    for (size_t i = 0; i < n; ++i) triangles += piece_of[i] == 1;
    CHECK(triangles == pieces[1].triangles && triangles < n);
    size_t corners = 0;
    CHECK(terrane_mesh_triangles(terrane_selected_mesh(made), &corners) != NULL && corners == n);
    CHECK(terrane_selected_cavities(made) == 1 && terrane_selected_volume(made) == 33);
    CHECK(same_text(terrane_selected_exact_volume(made, TERRANE_NONE), "33"));
    CHECK(same_text(terrane_selected_exact_volume(made, 0), "7"));
    CHECK(terrane_selected_exact_volume(made, 2) == NULL);
    CHECK(terrane_selected_is_surface(made) == 0);
    terrane_selected_free(made);
    WORKS(terrane_select(s, "t & inside(a)", NULL, NULL, &made, &error));
    CHECK(terrane_selected_is_surface(made) == 1 && terrane_selected_volume(made) == 0);
    CHECK(terrane_selected_pieces(made, &n) != NULL || n == 0);
    CHECK(same_text(terrane_selected_exact_volume(made, TERRANE_NONE), ""));
    terrane_selected_free(made);
    options.rule = TERRANE_INSIDE_POSITIVE;
    WORKS(terrane_select(s, "a & below(t)", &options, NULL, &made, &error));
    CHECK(same_text(terrane_selected_exact_volume(made, TERRANE_NONE), "4"));
    terrane_selected_free(made);
    FAILS(TERRANE_BAD_OPTION, terrane_select(s, "a +", NULL, NULL, &made, &error));
    FAILS(TERRANE_NOT_CLOSED, terrane_select(s, "a & t", NULL, NULL, &made, &error));
    options.rule = 7;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_select(s, "a", &options, NULL, &made, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_select(s, NULL, NULL, NULL, &made, &error));
    terrane_surfaces_free(s);
}

void test_reconstruction(void) {
    test_holes();
    test_layers();
    test_selections();
}
