// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Volumes, points in blocks, structure and models.
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void test_volumes(void) {
    terrane_surfaces* const s = small_surfaces();
    terrane_arrangement* a = NULL;
    terrane_mesh* mesh = NULL;
    terrane_volumes *exact = NULL, *volumes = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    WORKS(terrane_find_exact_volumes(a, NULL, &exact, &error));
    WORKS(terrane_find_volumes(mesh, NULL, &volumes, &error));
    size_t n = 0, triangles = 0;
    const double* const measures = terrane_volumes_measures(volumes, &n);
    CHECK(n == 2 && isinf(measures[0]) && measures[1] == 4.5 &&
          terrane_volumes_total(volumes) == 4.5);
    char text[8];
    size_t length = 0;
    WORKS(terrane_volumes_exact(exact, 1, text, sizeof text, &length, &error));
    CHECK(strcmp(text, "9/2") == 0 && length == 3);
    WORKS(terrane_volumes_exact(volumes, 1, text, 2, &length, &error)); // cut short
    CHECK(strcmp(text, "9") == 0 && length == 3);
    FAILS(TERRANE_BAD_INDEX, terrane_volumes_exact(volumes, 0, text, sizeof text, NULL, &error));
    FAILS(TERRANE_BAD_INDEX, terrane_volumes_exact(volumes, 2, text, sizeof text, NULL, &error));
    const uint32_t* const sides = terrane_volumes_of_sides(volumes, &n);
    terrane_mesh_triangles(mesh, &triangles);
    CHECK(n == triangles && sides[0] == 0 && sides[1] == 0); // the horizon dangles

    const double points[] = {9.5, 0.5, 0.5, 9, 0, 0, 8.9, 1, 1, 12, 0, 0};
    uint32_t blocks[4] = {9, 9, 9, 9};
    WORKS(terrane_locate_points(volumes, points, 4, NULL, blocks, &error));
    // A point on the body counts to the side of greater x, y, z.
    CHECK(blocks[0] == 1 && blocks[1] == 1 && blocks[2] == 0 && blocks[3] == 0);
    WORKS(terrane_locate_points(volumes, NULL, 0, NULL, NULL, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_locate_points(exact, points, 4, NULL, blocks, &error));
    const double bad[] = {0, 0, 0, 0, NAN, 0};
    CHECK(terrane_locate_points(volumes, bad, 2, NULL, blocks, &error) == TERRANE_BAD_NUMBER);
    CHECK(same_text(terrane_error_place(error), "point 1"));
    terrane_error_free(error);
    error = NULL;
    terrane_structure* structure = NULL;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_build_structure(exact, &structure, &error));
    WORKS(terrane_build_structure(volumes, &structure, &error));
    terrane_structure_blocks(structure, &n);
    CHECK(n == 2);
    terrane_structure_free(structure);
    terrane_mesh_free(mesh); // the volumes keep what they need
    WORKS(terrane_locate_points(volumes, points, 1, NULL, blocks, &error));
    terrane_volumes_free(volumes);
    terrane_volumes_free(exact);
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
}

/// Two horizons that are 0.2 apart on one half and a fault: what is nearer than 0.5 is joined.
static void test_resolution(void) {
    const double low[] = {0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0};
    const double high[] = {0, 0, 0.2, 10, 0, 4, 10, 10, 4, 0, 10, 0.2};
    const double corner[] = {-1, -1, -4}, opposite[] = {11, 11, 6};
    const uint32_t square[] = {0, 1, 2, 0, 2, 3};
    terrane_surfaces *s = NULL, *box = NULL;
    terrane_arrangement* a = NULL;
    terrane_mesh* mesh = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    WORKS(terrane_surfaces_add(s, "low", TERRANE_ROLE_HORIZON, low, 4, square, 2, &error));
    WORKS(terrane_surfaces_add(s, "high", TERRANE_ROLE_HORIZON, high, 4, square, 2, &error));
    WORKS(terrane_box_boundary(corner, opposite, &box, &error));
    WORKS(terrane_surfaces_append(s, box, &error));
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    terrane_simplify_options options;
    CHECK(terrane_simplify_options_init(&options, sizeof options) == TERRANE_OK);
    terrane_simplified* simple = NULL;
    FAILS(TERRANE_BAD_OPTION, terrane_simplify(mesh, &options, NULL, &simple, &error));
    options.resolution = 0.5;
    options.max_move = 0.4;
    WORKS(terrane_simplify(mesh, &options, NULL, &simple, &error));
    terrane_simplify_report report;
    CHECK(terrane_simplified_get_report(simple, &report, sizeof report) == TERRANE_OK);
    CHECK(report.corners + report.curves + report.sheets > 0 && report.max_move == 0.4);
    CHECK(report.vanished == 0 && report.attempts >= 1);
    CHECK(terrane_surfaces_count(terrane_simplified_surfaces(simple)) == 8);
    const terrane_mesh* const joined = terrane_simplified_mesh(simple);
    CHECK(terrane_mesh_is_conforming(joined) == 1);
    size_t n = 0, volumes = 0;
    const uint32_t* const before = terrane_simplified_block_before(simple, &n);
    terrane_simplified_kept(simple, NULL);
    terrane_improve_options better;
    CHECK(terrane_improve_options_init(&better, sizeof better) == TERRANE_OK);
    better.max_deviation = 0.1;
    terrane_improved *improved = NULL, *other = NULL;
    WORKS(terrane_improve(joined, &better, NULL, &improved, &error));
    int32_t is_shown = -1;
    WORKS(terrane_simplified_keeps_resolution(simple, improved, NULL, &is_shown, &error));
    CHECK(is_shown == 1);
    terrane_model* model = NULL;
    WORKS(terrane_make_model(terrane_simplified_arrangement(simple), joined, improved, NULL, NULL,
                             &model, &error));
    terrane_volumes_measures(terrane_model_volumes(model), &volumes);
    CHECK(volumes == n && n >= 2 && before[0] == 0);
    WORKS(terrane_improve(mesh, &better, NULL, &other, &error));
    FAILS(TERRANE_BAD_OPTION,
          terrane_simplified_keeps_resolution(simple, other, NULL, &is_shown, &error));
    terrane_improved_free(other);
    terrane_model_free(model);
    terrane_improved_free(improved);
    terrane_simplified_free(simple);
    terrane_mesh_free(mesh);
    terrane_arrangement_free(a);
    terrane_surfaces_free(box);
    terrane_surfaces_free(s);
}

struct chain {
    terrane_surfaces* surfaces;
    terrane_arrangement* whole;
    terrane_cut* cut;
    terrane_mesh* mesh;
};

static struct chain make_chain(void) {
    struct chain c = {NULL, NULL, NULL, NULL};
    uint32_t boundary[6];
    c.surfaces = boxed_surfaces(boundary);
    WORKS(terrane_arrange(c.surfaces, NULL, NULL, &c.whole, &error));
    WORKS(terrane_cut_to_volume(c.whole, boundary, 6, NULL, &c.cut, &error));
    WORKS(terrane_round(terrane_cut_arrangement(c.cut), NULL, NULL, &c.mesh, &error));
    return c;
}

static void free_chain(struct chain c) {
    terrane_mesh_free(c.mesh);
    terrane_cut_free(c.cut);
    terrane_arrangement_free(c.whole);
    terrane_surfaces_free(c.surfaces);
}

/// Each entry of a list is an index below `limit`; there are `count` lists.
static void check_lists(const terrane_structure* s, terrane_structure_list which, size_t count,
                        size_t limit) {
    terrane_lists lists;
    CHECK(terrane_structure_get_lists(s, which, &lists) == TERRANE_OK);
    CHECK(lists.count == count);
    for (size_t i = 0; lists.count > 0 && i < lists.offsets[lists.count]; ++i)
        CHECK(lists.values[i] < limit);
}

static void test_structure(const terrane_model* model) {
    const terrane_structure* const s = terrane_model_structure(model);
    size_t corners = 0, lines = 0, patches = 0, interfaces = 0, blocks = 0, triangles = 0,
           vertices = 0, n = 0;
    const uint32_t* const c = terrane_structure_corners(s, &corners);
    const terrane_model_line* const l = terrane_structure_lines(s, &lines);
    const terrane_model_patch* const p = terrane_structure_patches(s, &patches);
    const terrane_model_interface* const f = terrane_structure_interfaces(s, &interfaces);
    const terrane_model_block* const b = terrane_structure_blocks(s, &blocks);
    const size_t surfaces = terrane_mesh_surface_count(terrane_model_mesh(model));
    terrane_mesh_triangles(terrane_model_mesh(model), &triangles);
    terrane_mesh_vertices(terrane_model_mesh(model), &vertices);
    CHECK(blocks == 7 && same_text(terrane_structure_block_name(s, 0), "outside"));
    CHECK(b[0].volume == 0 && isnan(b[1].age) && b[1].area > 0);
    double sum = 0;
    for (size_t i = 1; i < blocks; ++i) sum += b[i].volume;
    CHECK(fabs(sum - 800) < 1e-9);
    for (size_t i = 0; i < corners; ++i) CHECK(c[i] < vertices);
    for (size_t i = 0; i < lines; ++i) {
        CHECK(!same_text(terrane_line_kind_name(l[i].kind), "unknown") && l[i].length > 0);
        CHECK(l[i].corners[0] == TERRANE_NONE || l[i].corners[0] < corners);
    }
    double area = 0;
    for (size_t i = 0; i < patches; ++i) {
        CHECK(p[i].interface_number < interfaces);
        area += p[i].area;
    }
    for (size_t i = 0; i < interfaces; ++i) {
        CHECK(f[i].volumes[0] <= f[i].volumes[1] && f[i].volumes[1] < blocks);
        area -= f[i].area;
    }
    CHECK(fabs(area) < 1e-9);
    const uint32_t* const patch_of = terrane_structure_patch_of(s, &n);
    const uint32_t* const interface_of = terrane_structure_interface_of(s, NULL);
    CHECK(n == triangles);
    for (size_t t = 0; t < n; ++t) CHECK(p[patch_of[t]].interface_number == interface_of[t]);

    check_lists(s, TERRANE_CORNER_LINES, corners, lines);
    check_lists(s, TERRANE_LINE_VERTICES, lines, vertices);
    check_lists(s, TERRANE_LINE_PATCHES, lines, patches);
    check_lists(s, TERRANE_LINE_SURFACES, lines, surfaces);
    check_lists(s, TERRANE_PATCH_TRIANGLES, patches, triangles);
    check_lists(s, TERRANE_PATCH_LINES, patches, lines);
    check_lists(s, TERRANE_INTERFACE_SURFACES, interfaces, surfaces);
    check_lists(s, TERRANE_INTERFACE_PATCHES, interfaces, patches);
    check_lists(s, TERRANE_INTERFACE_TRIANGLES, interfaces, triangles);
    check_lists(s, TERRANE_BLOCK_SURFACES_ABOVE, blocks, surfaces);
    check_lists(s, TERRANE_BLOCK_SURFACES_BELOW, blocks, surfaces);
    check_lists(s, TERRANE_BLOCK_SURFACES_BESIDE, blocks, surfaces);
    check_lists(s, TERRANE_BLOCK_INTERFACES, blocks, interfaces);
    check_lists(s, TERRANE_BLOCK_INNER_INTERFACES, blocks, interfaces);
    check_lists(s, TERRANE_BLOCK_NEIGHBOURS, blocks, blocks);
    terrane_lists lists;
    CHECK(terrane_structure_get_lists(s, 15, &lists) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_structure_get_lists(s, -1, &lists) == TERRANE_BAD_ARGUMENT);
}

static void test_column(struct chain c) {
    terrane_model* model = NULL;
    terrane_model_options options;
    CHECK(terrane_model_options_init(&options, sizeof options) == TERRANE_OK);
    const terrane_column_unit units[] = {
        {"cover", "top", 10, 0, 0}, {"middle", "base", 20, 1, 0}, {"basement", NULL, NAN, 0, 0}};
    options.column = units;
    options.unit_count = 3;
    WORKS(terrane_make_model(terrane_cut_arrangement(c.cut), c.mesh, NULL, &options, NULL, &model,
                             &error));
    const terrane_structure* const s = terrane_model_structure(model);
    size_t n = 0, named = 0;
    const terrane_model_block* const blocks = terrane_structure_blocks(s, &n);
    for (size_t b = 1; b < n; ++b)
        if (same_text(terrane_structure_block_unit(s, b), "cover")) {
            ++named;
            CHECK(blocks[b].age == 10);
        }
    CHECK(named == 2); // on the two sides of the fault
    terrane_model_free(model);
    const terrane_column_unit twice[] = {{"cover", "top", 10, 0, 0}, {"cover", "base", 20, 0, 0}};
    options.column = twice;
    options.unit_count = 2;
    FAILS(TERRANE_BAD_OPTION, terrane_make_model(terrane_cut_arrangement(c.cut), c.mesh, NULL,
                                                 &options, NULL, &model, &error));
}

static void test_models(struct chain c) {
    const terrane_arrangement* const inside = terrane_cut_arrangement(c.cut);
    terrane_model* model = NULL;
    WORKS(terrane_make_model(inside, c.mesh, NULL, NULL, NULL, &model, &error));
    size_t n = 0;
    const double* const exact = terrane_model_exact_volumes(model, &n);
    CHECK(n == 7 && isinf(exact[0]) && terrane_model_total_volume(model) == 800);
    CHECK(terrane_model_lost(model) == 0 && terrane_model_made(model) == 0);
    test_structure(model);
    const double point[] = {1, 1, 0};
    uint32_t block = 0;
    WORKS(terrane_locate_points(terrane_model_volumes(model), point, 1, NULL, &block, &error));
    CHECK(block > 0 && exact[block] > 80 && exact[block] < 120);
    CHECK(
        contains(terrane_structure_block_name(terrane_model_structure(model), block), "below top"));
    char* json = NULL;
    WORKS(terrane_model_to_json(model, &json, &error));
    CHECK(contains(json, "\"terrane-model 1\"") && contains(json, "\"free_borders\""));
    terrane_text_free(json);

    terrane_improved* improved = NULL;
    terrane_model* better = NULL;
    WORKS(terrane_improve(c.mesh, NULL, NULL, &improved, &error));
    WORKS(terrane_make_model(inside, c.mesh, improved, NULL, NULL, &better, &error));
    CHECK(terrane_mesh_is_conforming(terrane_model_mesh(better)) == 1);
    terrane_structure_blocks(terrane_model_structure(better), &n);
    CHECK(n == 7);
    terrane_model_free(better);

    // Handles that do not belong together are refused.
    FAILS(TERRANE_BAD_OPTION,
          terrane_make_model(c.whole, c.mesh, NULL, NULL, NULL, &better, &error));
    terrane_mesh* again = NULL;
    WORKS(terrane_round(inside, NULL, NULL, &again, &error));
    FAILS(TERRANE_BAD_OPTION,
          terrane_make_model(inside, again, improved, NULL, NULL, &better, &error));
    CHECK(better == NULL);
    terrane_mesh_free(again);
    terrane_improved_free(improved);
    terrane_model_free(model);
}

void test_model(void) {
    test_volumes();
    test_resolution();
    const struct chain c = make_chain();
    test_models(c);
    test_column(c);
    free_chain(c);
}
