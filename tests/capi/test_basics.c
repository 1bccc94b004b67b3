// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Versions, names, errors; how stages run.
#include "support.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

void test_basics(void) {
    CHECK(terrane_abi_version() == TERRANE_ABI_VERSION);
    unsigned major = 0;
    const char* version = terrane_version();
    while (*version >= '0' && *version <= '9') major = 10 * major + (unsigned)(*version++ - '0');
    CHECK(*version == '.' && major < 1000);

    CHECK(same_text(terrane_code_name(TERRANE_OK), "ok"));
    CHECK(same_text(terrane_code_name(TERRANE_CANNOT_OPEN), "cannot_open"));
    CHECK(same_text(terrane_code_name(TERRANE_IMPROPER_CONTACT), "improper_contact"));
    CHECK(same_text(terrane_code_name(TERRANE_INTERNAL), "internal"));
    CHECK(same_text(terrane_code_name(TERRANE_BAD_ARGUMENT), "bad_argument"));
    CHECK(same_text(terrane_code_name(-1), "unknown"));
    CHECK(same_text(terrane_code_name(16), "unknown"));
    CHECK(same_text(terrane_contact_kind_name(0), "vertex on edge"));
    CHECK(same_text(terrane_contact_kind_name(6), "coplanar overlap"));
    CHECK(same_text(terrane_contact_kind_name(7), "unknown"));
    CHECK(same_text(terrane_contact_kind_name(-1), "unknown"));
    CHECK(same_text(terrane_line_kind_name(0), "free border"));
    CHECK(same_text(terrane_line_kind_name(5), "unknown"));
    CHECK(same_text(terrane_open_reason_name(99), "unknown"));
    CHECK(!same_text(terrane_open_reason_name(0), "unknown"));

    terrane_surfaces* s = NULL;
    CHECK(terrane_surfaces_new(&s, NULL) == TERRANE_OK); // the error is not asked for
    CHECK(terrane_surfaces_read(s, "/no such folder/no.ts", NULL, &error) == TERRANE_CANNOT_OPEN);
    CHECK(terrane_error_code(error) == TERRANE_CANNOT_OPEN);
    CHECK(contains(terrane_error_place(error), "/no such folder/no.ts"));
    CHECK(strlen(terrane_error_sentence(error)) > 3);
    CHECK(strlen(terrane_error_message(error)) ==
          strlen(terrane_error_place(error)) + 2 + strlen(terrane_error_sentence(error)));
    terrane_error_free(error);
    error = NULL;
    CHECK(terrane_surfaces_read(s, "/no such folder/no.ts", NULL, NULL) == TERRANE_CANNOT_OPEN);
    CHECK(terrane_surfaces_count(s) == 0);
    terrane_surfaces_free(s);

    CHECK(terrane_error_code(NULL) == TERRANE_OK);
    CHECK(same_text(terrane_error_message(NULL), ""));
    CHECK(same_text(terrane_error_sentence(NULL), ""));
    CHECK(same_text(terrane_error_place(NULL), ""));
    terrane_error_free(NULL);
    terrane_keep_freed_memory();
    const int first = terrane_survive_gmp_out_of_memory();
    CHECK(first == 0 || first == 1);
}

// --- Runs
// -------------------------------------------------------------------------------------------

struct watch {
    int calls, stop_at;
    double last;
    char stages[4096];
};

static int watch_progress(const char* stage, double share, void* user) {
    struct watch* const w = user;
    w->last = share;
    if (strlen(w->stages) + strlen(stage) + 2 < sizeof w->stages)
        strcat(strcat(w->stages, stage), " ");
    return ++w->calls == w->stop_at;
}

static void watch_timing(const char* stage, double seconds, void* user) {
    struct watch* const w = user;
    if (strlen(w->stages) + strlen(stage) + 2 < sizeof w->stages)
        strcat(strcat(w->stages, stage), " ");
    if (seconds >= 0) ++w->calls;
}

/// Returns many squares that cross each other.
static terrane_surfaces* many_crossings(void) {
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    for (int k = 0; k < 12; ++k) {
        const double z = k * 0.1, tilted[] = {0, 0, z, 9, 0, 1 - z, 9, 9, z, 0, 9, 1.5 - z};
        const uint32_t square[] = {0, 1, 2, 0, 2, 3};
        WORKS(
            terrane_surfaces_add(s, "tilted", TERRANE_ROLE_UNKNOWN, tilted, 4, square, 2, &error));
        add_square(s, "flat", TERRANE_ROLE_UNKNOWN, z, 10, 6, 0);
    }
    return s;
}

static void* stop_it(void* run) {
    terrane_run_request_stop(run, NULL);
    return NULL;
}

static void test_stops(terrane_run* run, const terrane_surfaces* s) {
    struct watch w = {0, 1, 0, ""};
    terrane_arrangement* a = NULL;
    WORKS(terrane_run_set_progress(run, watch_progress, &w, &error));
    CHECK(terrane_run_stop_requested(run) == 0);
    FAILS(TERRANE_INTERRUPTED, terrane_arrange(s, NULL, run, &a, &error));
    CHECK(a == NULL && terrane_run_stop_requested(run) == 1);
    WORKS(terrane_run_set_progress(run, NULL, NULL, &error));
    FAILS(TERRANE_INTERRUPTED, terrane_arrange(s, NULL, run, &a, &error)); // until it is reset
    WORKS(terrane_run_reset(run, &error));
    WORKS(terrane_arrange(s, NULL, run, &a, &error));
    terrane_arrangement_free(a);

    pthread_t other;
    CHECK(pthread_create(&other, NULL, stop_it, run) == 0);
    pthread_join(other, NULL);
    CHECK(terrane_run_stop_requested(run) == 1);
    FAILS(TERRANE_INTERRUPTED, terrane_arrange(s, NULL, run, &a, &error));
    WORKS(terrane_run_reset(run, &error));
}

struct work {
    const terrane_surfaces* surfaces;
    terrane_code code;
    size_t triangles;
};

static void* arrange_it(void* given) {
    struct work* const w = given;
    terrane_arrangement* a = NULL;
    w->code = terrane_arrange(w->surfaces, NULL, NULL, &a, NULL);
    terrane_arrangement_triangles(a, &w->triangles);
    terrane_arrangement_free(a);
    return NULL;
}

/// Several threads arrange the same surfaces at a time.
static void test_callers_at_once(const terrane_surfaces* s, size_t triangles) {
    pthread_t threads[4];
    struct work work[4];
    for (int i = 0; i < 4; ++i) {
        work[i] = (struct work){s, TERRANE_INTERNAL, 0};
        CHECK(pthread_create(&threads[i], NULL, arrange_it, &work[i]) == 0);
    }
    for (int i = 0; i < 4; ++i) {
        pthread_join(threads[i], NULL);
        CHECK(work[i].code == TERRANE_OK && work[i].triangles == triangles);
    }
}

void test_runs(void) {
    terrane_surfaces* const s = many_crossings();
    terrane_run* run = NULL;
    WORKS(terrane_run_new(&run, &error));
    struct watch progress = {0, 0, 0, ""}, timing = {0, 0, 0, ""};
    WORKS(terrane_run_set_progress(run, watch_progress, &progress, &error));
    WORKS(terrane_run_set_timing(run, watch_timing, &timing, &error));
    terrane_arrangement *one = NULL, *two = NULL;
    WORKS(terrane_arrange(s, NULL, run, &one, &error));
    CHECK(progress.calls > 0 && contains(progress.stages, "arrange"));
    CHECK(progress.last >= 0 && progress.last <= 1);
    CHECK(timing.calls > 0 && contains(timing.stages, "arrange/search"));
    WORKS(terrane_run_set_progress(run, NULL, NULL, &error));
    WORKS(terrane_run_set_timing(run, NULL, NULL, &error));

    WORKS(terrane_run_set_threads(run, 2, &error)); // the same result with any number of threads
    WORKS(terrane_arrange(s, NULL, run, &two, &error));
    size_t n1 = 0, n2 = 0;
    const uint32_t* const t1 = terrane_arrangement_triangles(one, &n1);
    const uint32_t* const t2 = terrane_arrangement_triangles(two, &n2);
    CHECK(n1 > 1000 && n1 == n2 && memcmp(t1, t2, n1 * 3 * sizeof(uint32_t)) == 0);
    terrane_arrangement_free(two);
    WORKS(terrane_run_set_threads(run, 0, &error)); // one for each processor
    WORKS(terrane_arrange(s, NULL, run, &two, &error));
    terrane_arrangement_free(two);
    terrane_arrangement_free(one);

    test_stops(run, s);
    test_callers_at_once(s, n1);
    terrane_run_free(run);
    terrane_surfaces_free(s);
}
