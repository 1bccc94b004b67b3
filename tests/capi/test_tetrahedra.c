// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra in the blocks of a model. TERRANE_TETGEN_HELPER is the helper program of this build.
#include "support.h"

#include <math.h>
#include <stdlib.h>

/// Returns the model of two horizons and a fault in a box.
static terrane_model* make_model(void) {
    uint32_t boundary[6];
    terrane_surfaces* const s = boxed_surfaces(boundary);
    terrane_arrangement* a = NULL;
    terrane_cut* cut = NULL;
    terrane_mesh* mesh = NULL;
    terrane_model* model = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_cut_to_volume(a, boundary, 6, NULL, &cut, &error));
    WORKS(terrane_round(terrane_cut_arrangement(cut), NULL, NULL, &mesh, &error));
    WORKS(terrane_make_model(terrane_cut_arrangement(cut), mesh, NULL, NULL, NULL, &model, &error));
    terrane_mesh_free(mesh);
    terrane_cut_free(cut);
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
    return model;
}

static double volume_of(const double* p, const uint32_t* c) {
    double e[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            e[i][k] = p[3 * c[i + 1] + (uint32_t)k] - p[3 * c[0] + (uint32_t)k];
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6;
}

static void test_cells(const terrane_tetrahedra* t) {
    size_t vertices = 0, cells = 0, faces = 0, n = 0;
    const double* const p = terrane_tetrahedra_vertices(t, &vertices);
    const uint32_t* const c = terrane_tetrahedra_cells(t, &cells);
    const uint32_t* const block = terrane_tetrahedra_block_of(t, &n);
    CHECK(cells > 20 && n == cells && terrane_tetrahedra_block_count(t) == 7);
    double measured[7] = {0};
    for (size_t i = 0; i < cells; ++i) {
        for (int k = 0; k < 4; ++k) CHECK(c[4 * i + (size_t)k] < vertices);
        CHECK(volume_of(p, c + 4 * i) * volume_of(p, c) > 0);
        CHECK(block[i] < 7);
        measured[block[i] % 7] += fabs(volume_of(p, c + 4 * i));
    }
    const terrane_block_volume* const volumes = terrane_tetrahedra_volumes(t, &n);
    CHECK(n == 7);
    for (size_t r = 0; r < 7; ++r)
        CHECK(fabs(volumes[r].block - measured[r]) < 1e-9 * (1 + measured[r]) &&
              volumes[r].is_equal == (volumes[r].difference == 0));
    const uint32_t* const f = terrane_tetrahedra_faces(t, &faces);
    CHECK(faces > 20 && f[0] < vertices);
    CHECK(terrane_tetrahedra_face_triangle(t, &n) != NULL && n == faces);
    terrane_lists lists;
    CHECK(terrane_tetrahedra_face_surfaces(t, &lists) == TERRANE_OK && lists.count == faces);
    CHECK(same_text(terrane_tetrahedra_surface_name(t, 0), "top"));
    CHECK(terrane_tetrahedra_surface_name(t, terrane_tetrahedra_surface_count(t)) == NULL);
    CHECK(same_text(terrane_tetrahedra_block_name(t, 0), "outside"));
    CHECK(terrane_tetrahedra_block_name(t, 7) == NULL);
    CHECK(same_text(terrane_tetrahedra_mesher(t), "TetGen"));
    CHECK(terrane_tetrahedra_violation_count(t) == 0 && terrane_tetrahedra_violation(t, 0) == NULL);
}

void test_tetrahedra(void) {
    terrane_tetrahedra_options options;
    CHECK(terrane_tetrahedra_options_init(&options, sizeof options) == TERRANE_OK);
    CHECK(options.time_limit == 600 && options.margin == 0.1);
    terrane_model* const model = make_model();
    terrane_tetrahedra* t = NULL;
    options.helper = "/no such folder/terrane-tetgen";
    options.mesher = TERRANE_MESHER_TETGEN;
    FAILS(TERRANE_CANNOT_OPEN, terrane_tetrahedralize(model, &options, NULL, &t, &error));
    options.mesher = 3;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_tetrahedralize(model, &options, NULL, &t, &error));
    options.mesher = TERRANE_MESHER_AUTOMATIC;
#ifdef TERRANE_TETGEN_HELPER
    options.helper = TERRANE_TETGEN_HELPER;
    options.skip_outside = 1;
    WORKS(terrane_tetrahedralize(model, &options, NULL, &t, &error));
    test_cells(t);
    size_t few = 0, many = 0, twins = 0;
    terrane_tetrahedra_cells(t, &few);
    terrane_tetrahedra_twins(t, &twins);
    CHECK(twins == 0);
    WORKS(terrane_tetrahedra_write(t, path_in(work_folder, "model.vtu"), NULL, &error));
    FAILS(TERRANE_UNSUPPORTED,
          terrane_tetrahedra_write(t, path_in(work_folder, "model.obj"), NULL, &error));
    terrane_shape_report shapes;
    CHECK(terrane_tetrahedra_shape_report(t, &shapes, sizeof shapes) == TERRANE_OK);
    CHECK(shapes.passes > 0 && shapes.quality_after > shapes.quality_before &&
          shapes.quality_before > 0 && shapes.quality_after < 1);
    CHECK(shapes.least_angle_after > 0 && shapes.largest_angle_after < 180);
    CHECK(terrane_tetrahedra_shape_report(NULL, &shapes, sizeof shapes) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_tetrahedra_shape_report(t, NULL, sizeof shapes) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_tetrahedra_shape_report(t, &shapes, 1000) == TERRANE_BAD_ARGUMENT);
    terrane_tetrahedra_free(t);
    options.keep_shapes = 1;
    WORKS(terrane_tetrahedralize(model, &options, NULL, &t, &error));
    CHECK(terrane_tetrahedra_shape_report(t, &shapes, sizeof shapes) == TERRANE_OK);
    CHECK(shapes.passes == 0 && shapes.quality_before == 0 && shapes.left == 0);
    terrane_tetrahedra_free(t);
    options.keep_shapes = 0;

    const terrane_named_size finer[] = {{"F1", 1.5}};
    const char* const split[] = {"fault"};
    options.size_of = finer;
    options.size_of_count = 1;
    options.split = split;
    options.split_count = 1;
    WORKS(terrane_tetrahedralize(model, &options, NULL, &t, &error));
    terrane_tetrahedra_cells(t, &many);
    terrane_tetrahedra_twins(t, &twins);
    CHECK(many > few && twins > 0);
    terrane_tetrahedra_free(t);
    const terrane_named_size wrong[] = {{"F9", 1}};
    options.size_of = wrong;
    CHECK(terrane_tetrahedralize(model, &options, NULL, &t, &error) == TERRANE_BAD_OPTION);
    CHECK(same_text(terrane_error_place(error), "options.size_of[0]"));
    terrane_error_free(error);
    error = NULL;
    options.size_of_count = 0;
    options.edge_length = NAN;
    FAILS(TERRANE_BAD_OPTION, terrane_tetrahedralize(model, &options, NULL, &t, &error));
    CHECK(t == NULL);
#else
    (void)test_cells;
#endif
    terrane_model_free(model);
}
