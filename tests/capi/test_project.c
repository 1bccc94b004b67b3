// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Whole projects. The files that are written here are compared with the program's (run.py).
#include "support.h"

#include <stdlib.h>
#include <string.h>

static const char* const project =
    "{\"format\": \"terrane-project 1\","
    " \"surfaces\": [{\"file\": \"top.ts\", \"role\": \"horizon\"},"
    " {\"file\": \"base.ts\", \"role\": \"horizon\", \"name\": \"bottom\"},"
    " {\"file\": \"fault.ts\", \"role\": \"fault\"}],"
    " \"volume_of_interest\": {\"box\": {\"low\": [0, 0, -1700], \"high\": [2000, 1500, -700]}},"
    " \"outputs\": {\"surfaces\": [\"vtp\"]}}";

static void check_built(const terrane_built* built) {
    const terrane_model* const model = terrane_built_model(built);
    size_t n = 0;
    terrane_structure_blocks(terrane_model_structure(model), &n);
    CHECK(n == 6);
    CHECK(same_text(terrane_mesh_surface_name(terrane_model_mesh(model), 1), "bottom"));
    CHECK(terrane_surfaces_count(terrane_built_surfaces(built)) == 9);
    terrane_arrangement_triangles(terrane_built_arrangement(built), &n);
    CHECK(n > 1000);
    terrane_model* again = NULL; // the parts fit together
    CHECK(terrane_mesh_is_conforming(terrane_model_mesh(model)) == 1);
    WORKS(terrane_make_model(terrane_built_arrangement(built), terrane_model_mesh(model), NULL,
                             NULL, NULL, &again, &error));
    CHECK(terrane_model_exact_volumes(again, NULL)[1] ==
          terrane_model_exact_volumes(model, NULL)[1]);
    terrane_model_free(again);
}

static void test_json(void) {
    terrane_built* built = NULL;
    WORKS(terrane_build(project, data_folder, NULL, NULL, &built, &error));
    check_built(built);
    CHECK(terrane_built_tetrahedra(built) == NULL);
    size_t n1 = 0, n2 = 0;
    const terrane_mesh* const mesh = terrane_model_mesh(terrane_built_model(built));
    const double* const v1 = terrane_mesh_vertices(mesh, &n1);

    terrane_surfaces* s = NULL; // the same surfaces, given instead of read
    terrane_built* other = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    WORKS(terrane_surfaces_read(s, path_in(data_folder, "top.ts"), NULL, &error));
    WORKS(terrane_surfaces_read(s, path_in(data_folder, "base.ts"), NULL, &error));
    FAILS(TERRANE_BAD_OPTION, terrane_build(project, NULL, s, NULL, &other, &error));
    WORKS(terrane_surfaces_read(s, path_in(data_folder, "fault.ts"), NULL, &error));
    WORKS(terrane_build(project, "/no such folder", s, NULL, &other, &error));
    check_built(other);
    const double* const v2 =
        terrane_mesh_vertices(terrane_model_mesh(terrane_built_model(other)), &n2);
    CHECK(n1 == n2 && memcmp(v1, v2, n1 * 3 * sizeof(double)) == 0);
    terrane_built_free(other);
    terrane_surfaces_free(s);
    terrane_built_free(built);
}

static void test_refusals(void) {
    terrane_built* built = NULL;
    FAILS(TERRANE_BAD_SYNTAX, terrane_build("{", NULL, NULL, NULL, &built, &error));
    CHECK(terrane_build("{\"surface\": []}", NULL, NULL, NULL, &built, &error) ==
          TERRANE_BAD_OPTION);
    CHECK(contains(terrane_error_message(error), "project: surface"));
    terrane_error_free(error);
    error = NULL;
    FAILS(TERRANE_CANNOT_OPEN,
          terrane_build(project, "/no such folder", NULL, NULL, &built, &error));
    FAILS(TERRANE_CANNOT_OPEN, terrane_build_file("/no such folder/p.json", NULL, &built, &error));
    CHECK(built == NULL);
}

/// Reads project.json, and writes what the program writes of it.
static void test_file(void) {
    terrane_run* run = NULL;
    terrane_built* built = NULL;
    WORKS(terrane_run_new(&run, &error));
    WORKS(terrane_run_set_threads(run, 2, &error));
    WORKS(terrane_build_file(path_in(work_folder, "project.json"), run, &built, &error));
    WORKS(terrane_mesh_write(terrane_model_mesh(terrane_built_model(built)),
                             path_in(work_folder, "built.vtp"), NULL, &error));
    const terrane_tetrahedra* const cells = terrane_built_tetrahedra(built);
    if (cells != NULL) {
        CHECK(terrane_tetrahedra_violation_count(cells) == 0);
        WORKS(terrane_tetrahedra_write(cells, path_in(work_folder, "built.vtu"), NULL, &error));
    }
    terrane_built_free(built);
    terrane_run_free(run);
}

/// Arranges the surfaces of three files, and writes the mesh as `terrane arrange` does.
static void test_arranged(void) {
    const char* const names[] = {"top.ts", "base.ts", "fault.ts"};
    terrane_surfaces* s = NULL;
    terrane_arrangement* a = NULL;
    terrane_mesh* mesh = NULL;
    terrane_model* model = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    for (int i = 0; i < 3; ++i)
        WORKS(terrane_surfaces_read(s, path_in(data_folder, names[i]), NULL, &error));
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    WORKS(terrane_mesh_write(mesh, path_in(work_folder, "arranged.vtp"), NULL, &error));
    WORKS(terrane_make_model(a, mesh, NULL, NULL, NULL, &model, &error));
    terrane_model_free(model);
    terrane_mesh_free(mesh);
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
}

void test_project(void) {
    test_json();
    test_refusals();
    test_file();
    test_arranged();
}
