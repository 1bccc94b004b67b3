// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The verifier.
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void test_results(void) {
    terrane_surfaces* const s = small_surfaces();
    terrane_arrangement* a = NULL;
    terrane_mesh *mesh = NULL, *crossing = NULL;
    terrane_verdict* verdict = NULL;
    WORKS(terrane_arrange(s, NULL, NULL, &a, &error));
    WORKS(terrane_verify_arrangement(s, a, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 1 && terrane_verdict_count(verdict) == 0);
    CHECK(terrane_verdict_rule(verdict, 0) == NULL && terrane_verdict_sentence(verdict, 0) == NULL);
    terrane_verdict_free(verdict);

    terrane_surfaces* other = NULL; // the arrangement is not that of other surfaces
    WORKS(terrane_surfaces_new(&other, &error));
    add_square(other, "flat", TERRANE_ROLE_UNKNOWN, 0, 4, 2, 0);
    WORKS(terrane_verify_arrangement(other, a, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 0 && terrane_verdict_count(verdict) > 0);
    CHECK(terrane_verdict_rule(verdict, 0)[0] == 'R');
    CHECK(strlen(terrane_verdict_sentence(verdict, 0)) > 5);
    terrane_verdict_free(verdict);
    terrane_surfaces_free(other);

    WORKS(terrane_round(a, NULL, NULL, &mesh, &error));
    WORKS(terrane_verify_mesh(mesh, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 1);
    terrane_verdict_free(verdict);
    WORKS(terrane_mesh_from_surfaces(s, &crossing, &error));
    WORKS(terrane_verify_mesh(crossing, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 0);
    CHECK(same_text(terrane_verdict_rule(verdict, 0), "R5"));
    size_t n = 0;
    const uint32_t* const elements = terrane_verdict_elements(verdict, 0, &n);
    CHECK(n == 2 && elements[0] < 2 && elements[1] == 2);
    CHECK(terrane_verdict_elements(verdict, 99, &n) == NULL && n == 0);
    terrane_verdict_free(verdict);
    terrane_mesh_free(crossing);
    terrane_mesh_free(mesh);
    terrane_arrangement_free(a);
    terrane_surfaces_free(s);
}

/// Writes a file with the contents of another one, of which the first `what` is replaced.
static int write_changed(const char* from, const char* to, const char* what, const char* by) {
    size_t size = 0;
    char* const text = contents_of(from, &size);
    char* const at = text == NULL ? NULL : strstr(text, what);
    FILE* const file = fopen(to, "wb");
    if (at != NULL && file != NULL) {
        fwrite(text, 1, (size_t)(at - text), file);
        fputs(by, file);
        fputs(at + strlen(what), file);
    }
    if (file != NULL) fclose(file);
    free(text);
    return at != NULL;
}

/// The certificate certified/model.json, which the program wrote, is about top.ts and fault.ts
/// next to it, and model.obj.
static void test_certificates(void) {
    const char* const path = path_in(work_folder, "certified/model.json");
    terrane_verdict* verdict = NULL;
    terrane_verify_options options;
    CHECK(terrane_verify_options_init(&options, sizeof options) == TERRANE_OK);
    CHECK(options.max_deviation < 0 && options.reading.struct_size == sizeof options.reading);
    WORKS(terrane_verify_certificate(path, NULL, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 1);
    terrane_verdict_free(verdict);

    char top[4096], fault[4096];
    snprintf(top, sizeof top, "%s/top.ts", data_folder);
    snprintf(fault, sizeof fault, "%s/fault.ts", data_folder);
    const char* const inputs[] = {top, fault}; // the same files elsewhere
    options.inputs = inputs;
    options.input_count = 2;
    WORKS(terrane_verify_certificate(path, &options, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 1);
    terrane_verdict_free(verdict);
    const char* const swapped[] = {fault, top};
    options.inputs = swapped;
    WORKS(terrane_verify_certificate(path, &options, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 0);
    CHECK(same_text(terrane_verdict_rule(verdict, 0), "R9"));
    terrane_verdict_free(verdict);
    options.input_count = 1;
    FAILS(TERRANE_BAD_OPTION, terrane_verify_certificate(path, &options, &verdict, &error));
    CHECK(verdict == NULL);

    // A certificate that states other edges is refuted, and so is one whose output file is not
    // there.
    const char* const forged = path_in(work_folder, "certified/forged.json");
    CHECK(write_changed(path, forged, "\"intersection_edges\":[[",
                        "\"intersection_edges\":[[0, 1], ["));
    WORKS(terrane_verify_certificate(forged, NULL, &verdict, &error));
    CHECK(terrane_verdict_is_valid(verdict) == 0 && terrane_verdict_rule(verdict, 0)[0] == 'R');
    terrane_verdict_free(verdict);
    CHECK(write_changed(path, forged, "model.obj", "other.obj"));
    WORKS(terrane_verify_certificate(forged, NULL, &verdict, &error));
    CHECK(terrane_verdict_count(verdict) == 1);
    CHECK(same_text(terrane_verdict_rule(verdict, 0), "output"));
    terrane_verdict_free(verdict);

    FAILS(TERRANE_CANNOT_OPEN,
          terrane_verify_certificate(path_in(work_folder, "none.json"), NULL, &verdict, &error));
    FAILS(TERRANE_BAD_SYNTAX, terrane_verify_certificate(top, NULL, &verdict, &error));
    CHECK(verdict == NULL);
}

static void test_judgement(void) {
    terrane_surfaces* const s = small_surfaces();
    terrane_mesh_judgement* judged = NULL;
    terrane_judge_options options;
    CHECK(terrane_judge_options_init(&options, sizeof options) == TERRANE_OK);
    CHECK(options.spacings == 16 && options.most_flaws == 10);
    options.most_flaws = 1;
    WORKS(terrane_judge(s, s, &options, NULL, &judged,
                        &error)); // inputs are no arrangement of theirs
    CHECK(terrane_mesh_judgement_holds(judged) == 0 && terrane_mesh_judgement_count(judged) == 8);
    terrane_property property;
    terrane_property_flaw flaw;
    CHECK(terrane_mesh_judgement_property(judged, 0, &property, sizeof property) == TERRANE_OK);
    CHECK(same_text(property.name, "conforming") && strlen(property.sentence) > 5);
    CHECK(property.verdict == TERRANE_PROPERTY_FAILS && property.count >= property.listed);
    CHECK(property.listed == 1);
    CHECK(terrane_mesh_judgement_flaw(judged, 0, 0, &flaw, sizeof flaw) == TERRANE_OK);
    CHECK(flaw.triangle_count == 2 && flaw.triangles[0] < flaw.triangles[1]);
    CHECK(terrane_mesh_judgement_flaw(judged, 0, 1, &flaw, sizeof flaw) == TERRANE_BAD_ARGUMENT);
    CHECK(terrane_mesh_judgement_property(judged, 8, &property, sizeof property) ==
          TERRANE_BAD_ARGUMENT);
    terrane_mesh_judgement_free(judged);
    WORKS(terrane_judge(s, NULL, NULL, NULL, &judged, &error)); // alone
    CHECK(terrane_mesh_judgement_property(judged, 3, &property, sizeof property) == TERRANE_OK);
    CHECK(same_text(property.name, "closed"));
    terrane_mesh_judgement_free(judged);
    options.operation = TERRANE_OPERATION_UNION;
    FAILS(TERRANE_NOT_CLOSED, terrane_judge(s, s, &options, NULL, &judged, &error));
    options.operation = 9;
    FAILS(TERRANE_BAD_ARGUMENT, terrane_judge(s, s, &options, NULL, &judged, &error));
    terrane_surfaces_free(s);
}

/// A tetrahedron that fills its faces.
static void test_judged_tetrahedra(void) {
    const double vertices[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4};
    const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    const uint32_t corners[] = {0, 1, 2, 3}, label[] = {5};
    terrane_surfaces* s = NULL;
    terrane_mesh_judgement* judged = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    WORKS(terrane_surfaces_add(s, "faces", TERRANE_ROLE_BOUNDARY, vertices, 4, faces, 4, &error));
    WORKS(terrane_judge_tetrahedra(vertices, 4, corners, 1, label, s, NULL, NULL, &judged, &error));
    CHECK(terrane_mesh_judgement_holds(judged) == 1 && terrane_mesh_judgement_count(judged) == 9);
    terrane_mesh_judgement_free(judged);
    WORKS(terrane_judge_tetrahedra(vertices, 4, corners, 1, NULL, s, NULL, NULL, &judged, &error));
    CHECK(terrane_mesh_judgement_count(judged) == 8);
    terrane_mesh_judgement_free(judged);
    WORKS(terrane_judge_tetrahedra(NULL, 0, NULL, 0, NULL, s, NULL, NULL, &judged, &error));
    CHECK(terrane_mesh_judgement_holds(judged) == 0);
    terrane_mesh_judgement_free(judged);
    FAILS(TERRANE_BAD_INDEX,
          terrane_judge_tetrahedra(vertices, 3, corners, 1, NULL, s, NULL, NULL, &judged, &error));
    FAILS(TERRANE_BAD_ARGUMENT, terrane_judge_tetrahedra(vertices, 4, corners, 1, NULL, NULL, NULL,
                                                         NULL, &judged, &error));
    terrane_surfaces_free(s);
}

void test_verification(void) {
    test_results();
    test_judgement();
    test_judged_tetrahedra();
    test_certificates();
}
