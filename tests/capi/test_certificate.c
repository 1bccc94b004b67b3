// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of all kinds. The folder `certified` has the files that the program wrote of top.ts,
// base.ts, fault.ts, salt.ts, shale.ts and holed.obj, and its certificates: those of the same
// results that this library writes are the same bytes, and the verifier accepts them.
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/// The inputs, the result and its files.
struct subject {
    terrane_input_file inputs[3];
    terrane_output_file outputs[2];
    terrane_certified certified;
    terrane_surfaces* surfaces;
    terrane_sealed* sealed;
    terrane_arrangement* arrangement;
    terrane_cut* cut;
    terrane_mesh* rounded;
};

static const char* certified_path(const char* name) {
    static char names[4][96];
    static unsigned next = 0;
    char* const relative = names[next++ % 4];
    snprintf(relative, sizeof names[0], "certified/%s", name);
    return path_in(work_folder, relative);
}

/// Keeps a path, which lives until the program ends.
static const char* kept(const char* path) {
    char* const copy = malloc(strlen(path) + 1);
    return copy == NULL ? path : strcpy(copy, path);
}

/// Reads input files, and names the output file.
static void begin(struct subject* s, const char* const* inputs, size_t count, const char* output) {
    memset(s, 0, sizeof *s);
    CHECK(terrane_certified_init(&s->certified, sizeof s->certified) == TERRANE_OK);
    CHECK(s->certified.struct_size == sizeof s->certified && s->certified.inputs == NULL);
    WORKS(terrane_surfaces_new(&s->surfaces, &error));
    for (size_t i = 0; i < count; ++i) {
        s->inputs[i].path = kept(certified_path(inputs[i]));
        WORKS(terrane_surfaces_read(s->surfaces, s->inputs[i].path, NULL, &error));
        s->inputs[i].surface_count = 1;
    }
    CHECK(terrane_surfaces_count(s->surfaces) == count);
    s->outputs[0].path = kept(certified_path(output));
    s->certified.inputs = s->inputs;
    s->certified.input_count = count;
    s->certified.outputs = s->outputs;
    s->certified.output_count = 1;
    s->certified.surfaces = s->surfaces;
}

/// Arranges the surfaces, cuts them by the last six where `boxed`, and rounds them.
static void arrange(struct subject* s, int boxed) {
    terrane_certified* const c = &s->certified;
    if (s->sealed != NULL) {
        c->surfaces = terrane_sealed_surfaces(s->sealed);
        c->arrangement = terrane_sealed_arrangement(s->sealed);
    } else {
        WORKS(terrane_arrange(s->surfaces, NULL, NULL, &s->arrangement, &error));
        c->arrangement = s->arrangement;
    }
    if (boxed) {
        uint32_t boundary[6];
        const uint32_t first = (uint32_t)terrane_surfaces_count(c->surfaces) - 6;
        for (uint32_t i = 0; i < 6; ++i) boundary[i] = first + i;
        WORKS(terrane_cut_to_volume(c->arrangement, boundary, 6, NULL, &s->cut, &error));
        c->arrangement = terrane_cut_arrangement(s->cut);
        c->boundary_count = 6;
    }
    WORKS(terrane_round(c->arrangement, NULL, NULL, &s->rounded, &error));
    CHECK(terrane_mesh_is_conforming(s->rounded));
    c->rounded = s->rounded;
}

static void end(struct subject* s) {
    terrane_mesh_free(s->rounded);
    terrane_cut_free(s->cut);
    terrane_arrangement_free(s->arrangement);
    terrane_sealed_free(s->sealed);
    terrane_surfaces_free(s->surfaces);
    for (size_t i = 0; i < COUNT(s->inputs); ++i) free((char*)s->inputs[i].path);
    for (size_t i = 0; i < COUNT(s->outputs); ++i) free((char*)s->outputs[i].path);
}

static void add_box(terrane_surfaces* surfaces) {
    const double low[] = {0, 0, -1700}, high[] = {2000, 1500, -700};
    terrane_surfaces* box = NULL;
    WORKS(terrane_box_boundary(low, high, &box, &error));
    WORKS(terrane_surfaces_append(surfaces, box, &error));
    terrane_surfaces_free(box);
}

static const double box_corners[] = {0, 0, 2000, 0, 2000, 1500, 0, 1500};

/// States the box of add_box.
static void state_box(terrane_certified* certified) {
    certified->corners = box_corners;
    certified->corner_count = 4;
    certified->low = -1700;
    certified->high = -700;
}

/// Writes the certificate, and compares it with the program's of this kind.
static void judge(const struct subject* s, const char* kind) {
    char name[64];
    size_t size = 0, other_size = 1;
    snprintf(name, sizeof name, "%s_by_c.json", kind);
    const char* const path = certified_path(name);
    WORKS(terrane_write_certificate(path, &s->certified, NULL, &error));
    snprintf(name, sizeof name, "%s.json", kind);
    char* const written = contents_of(path, &size);
    char* const expected = contents_of(certified_path(name), &other_size);
    if (!CHECK(written != NULL && size == other_size && memcmp(written, expected, size) == 0))
        fprintf(stderr, "the certificate %s is not the program's\n", kind);
    free(written);
    free(expected);
    terrane_verdict* verdict = NULL;
    WORKS(terrane_verify_certificate(path, NULL, &verdict, &error));
    if (!CHECK(terrane_verdict_is_valid(verdict) == 1))
        fprintf(stderr, "%s: %s\n", kind, terrane_verdict_sentence(verdict, 0));
    terrane_verdict_free(verdict);
}

static const char* const three[] = {"top.ts", "base.ts", "fault.ts"};

/// Calls that must be refused, of a certificate of an arrangement.
static void refuse(struct subject* s) {
    const char* const path = certified_path("refused.json");
    terrane_certified* const c = &s->certified;
    size_t size = 0;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_write_certificate(NULL, c, NULL, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_write_certificate(path, NULL, NULL, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_write_certificate("-", c, NULL, &error));
    c->struct_size = 1;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_write_certificate(path, c, NULL, &error));
    c->struct_size = sizeof *c;
    s->inputs[0].surface_count = 2;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    s->inputs[0].surface_count = SIZE_MAX;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    s->inputs[0].surface_count = 0;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    s->inputs[0].surface_count = 1;
    c->boundary_count = 4;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    c->boundary_count = 0;
    const terrane_surface_growth growth[] = {{3, 2}, {1, 1}, {1, 1}};
    c->growth = growth;
    c->growth_count = 2;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    c->growth_count = 3;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    c->growth = NULL;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_write_certificate(path, c, NULL, &error));
    c->growth_count = 0;
    s->outputs[0].format = "vtk";
    FAILS(TERRANE_UNSUPPORTED, terrane_write_certificate(path, c, NULL, &error));
    s->outputs[0].format = "tiff";
    FAILS(TERRANE_UNKNOWN_FORMAT, terrane_write_certificate(path, c, NULL, &error));
    s->outputs[0].format = NULL;
    const char* const there = s->outputs[0].path;
    s->outputs[0].path = certified_path("none.obj");
    FAILS(TERRANE_CANNOT_OPEN, terrane_write_certificate(path, c, NULL, &error));
    s->outputs[0].path = there;
    const terrane_mesh* const rounded = c->rounded;
    c->rounded = NULL;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_write_certificate(path, c, NULL, &error));
    terrane_mesh* foreign = NULL; // not what this arrangement was rounded to
    WORKS(terrane_mesh_from_surfaces(s->surfaces, &foreign, &error));
    c->rounded = foreign;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    terrane_mesh_free(foreign);
    c->rounded = rounded;
    terrane_surfaces* others = small_surfaces(); // which were not arranged
    c->surfaces = others;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    c->surfaces = s->surfaces;
    terrane_surfaces_free(others);
    WORKS(terrane_surfaces_label(s->surfaces, 0, "\xff", TERRANE_ROLE_HORIZON, &error));
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, c, NULL, &error));
    CHECK(contents_of(path, &size) == NULL); // nothing was written
}

static void test_arranged(void) {
    struct subject s;
    begin(&s, three, 3, "arrangement.obj");
    arrange(&s, 0);
    judge(&s, "arrangement");
    terrane_improved* improved = NULL;
    terrane_improve_options options;
    CHECK(terrane_improve_options_init(&options, sizeof options) == TERRANE_OK);
    options.edge_length = 150;
    WORKS(terrane_improve(s.rounded, &options, NULL, &improved, &error));
    const char* const arranged = s.outputs[0].path;
    s.outputs[0].path = certified_path("improved.vtp");
    s.certified.improved = improved;
    judge(&s, "improved");
    s.outputs[0].path = arranged;
    terrane_improved_free(improved);
    s.certified.improved = NULL;
    refuse(&s);
    end(&s);
}

static void test_cut(void) {
    struct subject s;
    begin(&s, three, 3, "cut.off");
    add_box(s.surfaces);
    arrange(&s, 1);
    state_box(&s.certified);
    judge(&s, "cut");
    end(&s);
}

static void test_sealed(void) {
    struct subject s;
    terrane_surface_growth growth[3];
    terrane_seal_options options;
    begin(&s, three, 3, "sealed.stl");
    for (size_t i = 0; i < 3; ++i) {
        size_t given = 0;
        terrane_surfaces_triangles(s.surfaces, i, &given);
        growth[i].given = growth[i].extended = given;
    }
    CHECK(terrane_seal_options_init(&options, sizeof options) == TERRANE_OK);
    options.distance = 20;
    WORKS(terrane_seal(s.surfaces, &options, NULL, &s.sealed, &error));
    arrange(&s, 0);
    s.certified.growth = growth;
    s.certified.growth_count = 3;
    judge(&s, "sealed");
    end(&s);
}

/// Blocks in a box, and tetrahedra in them.
static void test_blocks(void) {
    struct subject s;
    terrane_model* model = NULL;
    begin(&s, three, 3, "tetrahedra.vtu");
    add_box(s.surfaces);
    arrange(&s, 1);
    state_box(&s.certified);
    WORKS(terrane_make_model(s.certified.arrangement, s.rounded, NULL, NULL, NULL, &model, &error));
    s.certified.model = model;
    s.certified.output_count = 0;
    const char* const own = kept(certified_path("by_c"));
    const char* const path = certified_path("by_c.json");
    WORKS(terrane_model_write(model, own, NULL, NULL, &error));
    s.certified.model_folder = own;
    WORKS(terrane_write_certificate(path, &s.certified, NULL, &error));
    terrane_verdict* verdict = NULL;
    WORKS(terrane_verify_certificate(path, NULL, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 1);
    terrane_verdict_free(verdict);
    FAILS(TERRANE_CANNOT_OPEN, terrane_model_write(model, own, NULL, NULL, &error)); // not empty
    FAILS(TERRANE_UNKNOWN_FORMAT, terrane_model_write(model, own, "tiff", NULL, &error));
    s.certified.part_format = "obj"; // there are no such files
    FAILS(TERRANE_CANNOT_OPEN, terrane_write_certificate(path, &s.certified, NULL, &error));
    s.certified.part_format = NULL;
    s.certified.model = NULL;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, &s.certified, NULL, &error));
    s.certified.model = model;
    s.certified.model_folder = NULL;
    s.certified.output_count = 1;
    free((char*)own);
#ifdef TERRANE_TETGEN_HELPER
    terrane_tetrahedra* tetrahedra = NULL;
    terrane_tetrahedra_options options;
    CHECK(terrane_tetrahedra_options_init(&options, sizeof options) == TERRANE_OK);
    options.skip_outside = 1;
    options.keep_shapes = 1; // as in run.py
    options.helper = TERRANE_TETGEN_HELPER;
    WORKS(terrane_tetrahedralize(model, &options, NULL, &tetrahedra, &error));
    s.certified.tetrahedra = tetrahedra;
    judge(&s, "tetrahedra");
    s.certified.model = NULL;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(path, &s.certified, NULL, &error));
    terrane_tetrahedra_free(tetrahedra);
#endif
    terrane_model_free(model);
    end(&s);
}

static void test_filled(void) {
    struct subject s;
    terrane_fill_task task;
    terrane_holes* holes = NULL;
    begin(&s, (const char* const[]){"holed.obj"}, 1, "filled.vtp");
    CHECK(terrane_fill_task_init(&task, sizeof task, 0) == TERRANE_OK);
    WORKS(terrane_fill(s.surfaces, &task, 1, NULL, &holes, &error));
    s.certified.holes = holes;
    judge(&s, "filled");
    s.certified.boundary_count = 1;
    FAILS(TERRANE_BAD_OPTION,
          terrane_write_certificate(certified_path("no.json"), &s.certified, NULL, &error));
    terrane_holes_free(holes);
    end(&s);
}

static void test_layered(void) {
    struct subject s;
    const terrane_layer layers[] = {{1, 0, 1}, {0, 0, 2}};
    const terrane_layer turned[] = {{0, 0, 2}, {1, 0, 1}};
    terrane_layered* layered = NULL;
    begin(&s, (const char* const[]){"salt.ts", "shale.ts"}, 2, "layered.vtp");
    WORKS(terrane_stack_layers(s.surfaces, layers, 2, NULL, NULL, &layered, &error));
    s.certified.layered = layered;
    s.certified.layers = layers;
    s.certified.layer_count = 2;
    judge(&s, "layered");
    const char* const refused = certified_path("no.json");
    s.certified.layers = turned;
    FAILS(TERRANE_BAD_OPTION, terrane_write_certificate(refused, &s.certified, NULL, &error));
    s.certified.layers = NULL;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_write_certificate(refused, &s.certified, NULL, &error));
    terrane_layered_free(layered);
    end(&s);
}

void test_certificate(void) {
    terrane_certified certified;
    CHECK(terrane_certified_init(NULL, sizeof certified) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_certified_init(&certified, 1) == TERRANE_BAD_ARGUMENT);
    test_arranged();
    test_cut();
    test_sealed();
    test_blocks();
    test_filled();
    test_layered();
}
