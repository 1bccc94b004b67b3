// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

terrane_error* error = NULL;
const char* data_folder = ".";
const char* work_folder = ".";

static int failed = 0;

int failures(void) {
    return failed;
}

int check(int holds, const char* what, const char* file, int line) {
    if (!holds) {
        fprintf(stderr, "%s:%d: not so: %s\n", file, line, what);
        ++failed;
    }
    return holds;
}

int works(terrane_code code, const char* what, const char* file, int line) {
    const int good = code == TERRANE_OK && error == NULL;
    if (!good) {
        fprintf(stderr, "%s:%d: %s: %s, %s\n", file, line, what, terrane_code_name(code),
                terrane_error_message(error));
        ++failed;
    }
    terrane_error_free(error);
    error = NULL;
    return good;
}

int fails(terrane_code wanted, terrane_code code, const char* what, const char* file, int line) {
    const int good = code == wanted && terrane_error_code(error) == wanted &&
                     terrane_error_sentence(error)[0] != '\0' &&
                     strstr(terrane_error_message(error), terrane_error_sentence(error)) != NULL;
    if (!good) {
        fprintf(stderr, "%s:%d: %s: %s instead of %s, \"%s\"\n", file, line, what,
                terrane_code_name(code), terrane_code_name(wanted), terrane_error_message(error));
        ++failed;
    }
    terrane_error_free(error);
    error = NULL;
    return good;
}

int same_text(const char* a, const char* b) {
    return a != NULL && b != NULL && strcmp(a, b) == 0;
}

int contains(const char* text, const char* part) {
    return text != NULL && strstr(text, part) != NULL;
}

const char* path_in(const char* folder, const char* name) {
    static char paths[4][4096];
    static unsigned next = 0;
    char* const path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

char* contents_of(const char* path, size_t* size) {
    FILE* const file = fopen(path, "rb");
    if (file == NULL) return NULL;
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char* const contents = malloc(*size + 1);
    if (contents != NULL) contents[fread(contents, 1, *size, file)] = '\0';
    fclose(file);
    return contents;
}

terrane_surfaces* small_surfaces(void) {
    const double horizon[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    const double fault[] = {1, 0, -2, 1, 5, -1, 1, 2, 3};
    const double body[] = {9, 0, 0, 12, 0, 0, 9, 3, 0, 9, 0, 3};
    const uint32_t square[] = {0, 1, 2, 0, 2, 3};
    const uint32_t one[] = {0, 1, 2};
    const uint32_t closed[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    terrane_surfaces* s = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    WORKS(terrane_surfaces_add(s, "horizon", TERRANE_ROLE_HORIZON, horizon, 4, square, 2, &error));
    WORKS(terrane_surfaces_add(s, "fault", TERRANE_ROLE_FAULT, fault, 3, one, 1, &error));
    WORKS(terrane_surfaces_add(s, "body", TERRANE_ROLE_BOUNDARY, body, 4, closed, 4, &error));
    return s;
}

void add_square(terrane_surfaces* surfaces, const char* name, terrane_role role, double z,
                double size, unsigned n, int hole) {
    double* const vertices = malloc((n + 1) * (n + 1) * 3 * sizeof(double));
    uint32_t* const triangles = malloc(n * n * 6 * sizeof(uint32_t));
    size_t v = 0, t = 0;
    for (unsigned j = 0; j <= n; ++j)
        for (unsigned i = 0; i <= n; ++i) {
            vertices[v++] = size * i / n;
            vertices[v++] = size * j / n;
            vertices[v++] = z;
        }
    for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            const uint32_t cell[] = {a, b, d, a, d, c};
            const int middle = i >= n / 3 && i < n - n / 3 && j >= n / 3 && j < n - n / 3;
            if (hole && middle) continue;
            memcpy(triangles + t, cell, sizeof cell);
            t += 6;
        }
    WORKS(terrane_surfaces_add(surfaces, name, role, vertices, v / 3, triangles, t / 3, &error));
    free(vertices);
    free(triangles);
}

terrane_surfaces* boxed_surfaces(uint32_t boundary[6]) {
    const double fault[] = {5, -1, -9, 6, 11, -9, 5, 11, 9, 4, -1, 9};
    const uint32_t square[] = {0, 1, 2, 0, 2, 3};
    const double low[] = {0, 0, -4}, high[] = {10, 10, 4};
    terrane_surfaces *s = NULL, *box = NULL;
    WORKS(terrane_surfaces_new(&s, &error));
    add_square(s, "top", TERRANE_ROLE_HORIZON, 1, 10, 3, 0);
    add_square(s, "base", TERRANE_ROLE_HORIZON, -1, 10, 3, 0);
    WORKS(terrane_surfaces_add(s, "F1", TERRANE_ROLE_FAULT, fault, 4, square, 2, &error));
    WORKS(terrane_box_boundary(low, high, &box, &error));
    WORKS(terrane_surfaces_append(s, box, &error));
    terrane_surfaces_free(box);
    for (uint32_t i = 0; i < 6; ++i) boundary[i] = 3 + i;
    return s;
}
