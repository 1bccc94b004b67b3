// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrangement, cut, rounding, regions, quality and improvement.
#include "support.h"

#include <stdlib.h>
#include <string.h>

/// Whether some vertex has exactly these coordinates.
static int has_vertex(const terrane_arrangement* a, const char* x, const char* y, const char* z) {
    const char* const wanted[] = {x, y, z};
    size_t n = 0;
    terrane_arrangement_vertices(a, &n);
    for (size_t v = 0; v < n; ++v) {
        int same = 1;
        for (int axis = 0; axis < 3; ++axis) {
            char text[64];
            WORKS(terrane_arrangement_coordinate(a, v, axis, text, sizeof text, NULL, &error));
            same = same && strcmp(text, wanted[axis]) == 0;
        }
        if (same) return 1;
    }
    return 0;
}

static void test_exact(const terrane_surfaces* s, const terrane_arrangement* a) {
    terrane_arrangement_summary summary;
    CHECK(terrane_arrangement_get_summary(a, &summary, sizeof summary) == TERRANE_OK);
    CHECK(summary.input_triangles == 7 && summary.improper_contacts == 2);
    CHECK(has_vertex(a, "1", "4/5", "0")); // where the side of the fault meets the horizon
    CHECK(!has_vertex(a, "1", "4/5", "1"));
    size_t vertices = 0, triangles = 0, n = 0;
    CHECK(terrane_arrangement_vertices(a, &vertices) == terrane_arrangement_vertices(a, NULL));
    const uint32_t* const t = terrane_arrangement_triangles(a, &triangles);
    CHECK(vertices == summary.vertices && triangles == summary.triangles);
    for (size_t i = 0; i < 3 * triangles; ++i) CHECK(t[i] < vertices);
    const uint32_t* const edges = terrane_arrangement_intersection_edges(a, &n);
    CHECK(n == summary.intersection_edges && n >= 1 && edges[0] < edges[1]);
    terrane_lists parents, surfaces;
    CHECK(terrane_arrangement_parents(a, &parents) == TERRANE_OK && parents.count == triangles);
    CHECK(terrane_arrangement_surfaces(a, &surfaces) == TERRANE_OK && surfaces.count == triangles);
    CHECK(parents.offsets[0] == 0 && parents.offsets[triangles] >= triangles);
    CHECK(surfaces.values[0] == 0 && parents.values[0] < 7);
    terrane_arrangement_degenerate(a, &n);
    CHECK(n == 0);

    char digest[80], start[8];
    size_t length = 0;
    WORKS(terrane_arrangement_digest(a, s, NULL, digest, sizeof digest, &length, &error));
    CHECK(length == 71 && strncmp(digest, "sha256:", 7) == 0 && strlen(digest) == 71);
    WORKS(
        terrane_arrangement_digest(a, s, NULL, start, sizeof start, &length, &error)); // cut short
    CHECK(length == 71 && strcmp(start, "sha256:") == 0);
    WORKS(terrane_arrangement_digest(a, s, NULL, NULL, 0, &length, &error)); // the length alone
    CHECK(length == 71);
    terrane_surfaces* other = NULL;
    WORKS(terrane_surfaces_new(&other, &error));
    FAILS(TERRANE_BAD_OPTION, terrane_arrangement_digest(a, other, NULL, digest, 80, NULL, &error));
    terrane_surfaces_free(other);
    FAILS(TERRANE_BAD_INDEX,
          terrane_arrangement_coordinate(a, vertices, 0, digest, 80, NULL, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_arrangement_coordinate(a, 0, 3, digest, 80, NULL, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_arrangement_coordinate(a, 0, 0, NULL, 80, NULL, &error));
}

static void test_search(const terrane_surfaces* s, const terrane_arrangement* a) {
    terrane_arrange_options options;
    terrane_arrangement* b = NULL;
    CHECK(terrane_arrange_options_init(&options, sizeof options) == TERRANE_OK);
    options.search = "brute";
    WORKS(terrane_arrange(s, &options, NULL, &b, &error));
    size_t n1 = 0, n2 = 0;
    const uint32_t* const t1 = terrane_arrangement_triangles(a, &n1);
    const uint32_t* const t2 = terrane_arrangement_triangles(b, &n2);
    CHECK(n1 == n2 && memcmp(t1, t2, n1 * 3 * sizeof *t1) == 0);
    terrane_arrangement_free(b);
    options.search = "fastest";
    FAILS(TERRANE_BAD_OPTION, terrane_arrange(s, &options, NULL, &b, &error));
    CHECK(b == NULL);
}

static void test_mesh(const terrane_arrangement* a) {
    terrane_mesh *mesh = NULL, *proven = NULL;
    terrane_round_options options;
    CHECK(terrane_round_options_init(&options, sizeof options) == TERRANE_OK);
    CHECK(options.max_rounds == 8 && options.max_move < 0);
    options.full_check = 1;
    WORKS(terrane_round(a, &options, NULL, &mesh, &error));
    CHECK(terrane_mesh_is_conforming(mesh) == 1);
    terrane_rounding_report report;
    CHECK(terrane_mesh_get_rounding(mesh, &report, sizeof report) == TERRANE_OK);
    CHECK(report.is_conforming == 1 && report.vanished == 0 && report.max_move < 1e-12);
    size_t n = 0, triangles = 0, vertices = 0;
    terrane_mesh_contacts(mesh, &n);
    CHECK(n == 0);
    CHECK(terrane_mesh_surface_count(mesh) == 3);
    CHECK(same_text(terrane_mesh_surface_name(mesh, 2), "body"));
    CHECK(terrane_mesh_surface_name(mesh, 3) == NULL);
    CHECK(terrane_mesh_surface_role(mesh, 1) == TERRANE_ROLE_FAULT);
    const uint32_t* const t = terrane_mesh_triangles(mesh, &triangles);
    CHECK(terrane_mesh_vertices(mesh, &vertices) != NULL);
    for (size_t i = 0; i < 3 * triangles; ++i) CHECK(t[i] < vertices);
    terrane_lists surfaces, regions, parents;
    CHECK(terrane_mesh_surfaces(mesh, &surfaces) == TERRANE_OK && surfaces.count == triangles);
    CHECK(terrane_mesh_regions(mesh, &regions) == TERRANE_OK && regions.count == triangles);
    CHECK(terrane_mesh_parents(mesh, &parents) == TERRANE_OK && parents.count == triangles);
    const uint32_t* const edges = terrane_mesh_intersection_edges(mesh, &n);
    CHECK(n > 0 && edges[0] < vertices);
    WORKS(terrane_mesh_prove(mesh, NULL, &proven, &error));
    CHECK(terrane_mesh_is_conforming(proven) == 1);
    CHECK(terrane_mesh_triangles(proven, NULL) == t); // the mesh is shared
    terrane_mesh_free(mesh);
    CHECK(terrane_mesh_triangles(proven, &n) == t && n == triangles);
    WORKS(terrane_mesh_write(proven, path_in(work_folder, "mesh.vtp"), NULL, &error));
    FAILS(TERRANE_UNKNOWN_FORMAT,
          terrane_mesh_write(proven, path_in(work_folder, "mesh.xyzzy"), NULL, &error));
    terrane_mesh_free(proven);
}

static void test_regions(const terrane_arrangement* a) {
    terrane_mesh* mesh = NULL;
    terrane_regions* regions = NULL;
    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    WORKS(terrane_find_regions(mesh, NULL, &regions, &error));
    size_t n = 0, triangles = 0, sum = 0;
    const terrane_region* const array = terrane_regions_array(regions, &n);
    terrane_mesh_triangles(mesh, &triangles);
    for (size_t i = 0; i < n; ++i) sum += (size_t)array[i].triangles;
    CHECK(n >= 3 && sum == triangles && array[0].surface == 0);
    terrane_lists neighbours, of, known;
    CHECK(terrane_regions_neighbours(regions, &neighbours) == TERRANE_OK && neighbours.count == n);
    CHECK(terrane_regions_of_triangles(regions, &of) == TERRANE_OK && of.count == triangles);
    CHECK(terrane_mesh_regions(mesh, &known) == TERRANE_OK);
    CHECK(memcmp(of.values, known.values, of.offsets[of.count] * sizeof(uint32_t)) == 0);
    terrane_regions_free(regions);
    terrane_mesh_free(mesh);
}

static void test_unproven(const terrane_surfaces* s) {
    terrane_mesh *mesh = NULL, *proven = NULL;
    terrane_surfaces* back = NULL;
    WORKS(terrane_mesh_from_surfaces(s, &mesh, &error));
    CHECK(terrane_mesh_is_conforming(mesh) == 0);
    FAILS(TERRANE_IMPROPER_CONTACT, terrane_mesh_prove(mesh, NULL, &proven, &error));
    terrane_lists lists = {NULL, NULL, 7};
    CHECK(terrane_mesh_parents(mesh, &lists) == TERRANE_OK && lists.count == 0);
    WORKS(terrane_mesh_to_surfaces(mesh, &back, &error));
    CHECK(terrane_surfaces_count(back) == 3);
    size_t n1 = 0, n2 = 0;
    const double* const v1 = terrane_surfaces_vertices(s, 1, &n1);
    const double* const v2 = terrane_surfaces_vertices(back, 1, &n2);
    CHECK(n1 == n2 && memcmp(v1, v2, n1 * 3 * sizeof(double)) == 0);
    terrane_improved* improved = NULL;
    FAILS(TERRANE_IMPROPER_CONTACT, terrane_improve(mesh, NULL, NULL, &improved, &error));
    terrane_volumes* volumes = NULL;
    FAILS(TERRANE_IMPROPER_CONTACT, terrane_find_volumes(mesh, NULL, &volumes, &error));
    terrane_surfaces_free(back);
    terrane_mesh_free(mesh);
}

static void test_improvement(void) {
    uint32_t boundary[6];
    terrane_surfaces* const s = boxed_surfaces(boundary);
    terrane_arrangement* a = NULL;
    terrane_cut* cut = NULL;
    terrane_mesh* mesh = NULL;
    terrane_improved* improved = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_cut_to_volume(a, boundary, 6, NULL, &cut, &error));
    size_t n = 0;
    const terrane_surface_cut* const effects = terrane_cut_surfaces(cut, &n);
    CHECK(n == 9 && effects[0].area_inside == 100 && effects[0].area_outside == 0);
    CHECK(effects[2].area_outside > 1); // the fault goes on beyond the box
    WORKS(terrane_round(terrane_cut_arrangement(cut), NULL, NULL, &mesh, &error));
    terrane_improve_options options;
    CHECK(terrane_improve_options_init(&options, sizeof options) == TERRANE_OK);
    options.edge_length = 1;
    const double lengths[9] = {0, 0, 0.7};
    options.edge_length_of = lengths;
    options.edge_length_of_count = 9;
    WORKS(terrane_improve(mesh, &options, NULL, &improved, &error));
    const terrane_mesh* const better = terrane_improved_mesh(improved);
    CHECK(terrane_mesh_is_conforming(better) == 1);
    terrane_improve_report report;
    CHECK(terrane_improved_get_report(improved, &report, sizeof report) == TERRANE_OK);
    CHECK(report.sides_kept == 1 && report.splits > 0);
    CHECK(report.after.q.min >= report.before.q.min * (1 - 1e-9));
    const double* const bounds = terrane_improved_bounds(improved, &n);
    CHECK(n == 9 && bounds[0] >= 0 && bounds[0] < 0.1);
    terrane_quality quality;
    WORKS(terrane_measure_quality(better, NULL, &quality, sizeof quality, &error));
    CHECK(quality.triangles == report.after.triangles && quality.q.mean == report.after.q.mean);
    CHECK(quality.q.min > 0 && quality.q.max <= 1 && quality.worst < quality.triangles);
    options.edge_length_of_count = 2; // one for each surface, or none
    terrane_improved* none = NULL;
    FAILS(TERRANE_BAD_OPTION, terrane_improve(mesh, &options, NULL, &none, &error));
    terrane_improved_free(improved);
    terrane_mesh_free(mesh);
    terrane_cut_free(cut);
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
}

void test_arrangement(void) {
    terrane_surfaces* const s = small_surfaces();
    terrane_arrangement* a = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    test_exact(s, a);
    test_search(s, a);
    test_mesh(a);
    test_regions(a);
    terrane_arrangement_free(a);
    test_unproven(s);
    terrane_surfaces_free(s);
    test_improvement();
}
