// SPDX-License-Identifier: LGPL-3.0-or-later
//
// blocks IN...: cuts surfaces by a box, lists its blocks, and says in which block a point lies.
#include <stdint.h>
#include <stdio.h>

#include <terrane/terrane.h>

struct model {
    terrane_surfaces* surfaces;
    terrane_arrangement* exact;
    terrane_cut* inside;
    terrane_mesh* mesh;
    terrane_model* blocks;
};

static int make(struct model* m, int count, char** files, terrane_error** error) {
    const double low[] = {0, 0, -1700}, high[] = {2000, 1500, -700};
    terrane_surfaces* box = NULL;
    uint32_t boundary[6];
    if (terrane_surfaces_new(&m->surfaces, error)) return 2;
    for (int i = 0; i < count; ++i)
        if (terrane_surfaces_read(m->surfaces, files[i], NULL, error)) return 2;

    // The faces of the box are surfaces like others; `boundary` holds their numbers.
    for (uint32_t i = 0; i < 6; ++i)
        boundary[i] = (uint32_t)terrane_surfaces_count(m->surfaces) + i;
    if (terrane_box_boundary(low, high, &box, error)) return 2;
    const terrane_code added = terrane_surfaces_append(m->surfaces, box, error);
    terrane_surfaces_free(box);
    if (added) return 2;

    if (terrane_arrange(m->surfaces, NULL, NULL, &m->exact, error)) return 2;
    if (terrane_cut_to_volume(m->exact, boundary, 6, NULL, &m->inside, error)) return 2;
    const terrane_arrangement* inside = terrane_cut_arrangement(m->inside);
    if (terrane_round(inside, NULL, NULL, &m->mesh, error)) return 2;
    if (!terrane_mesh_is_conforming(m->mesh)) return 1; // terrane_mesh_contacts says where
    return terrane_make_model(inside, m->mesh, NULL, NULL, NULL, &m->blocks, error) ? 2 : 0;
}

static int show(const struct model* m, terrane_error** error) {
    const terrane_structure* structure = terrane_model_structure(m->blocks);
    size_t count = 0;
    const terrane_model_block* blocks = terrane_structure_blocks(structure, &count);
    for (size_t b = 1; b < count; ++b) // 0 is the outside
        printf("block %zu, %s: volume %.6g\n", b, terrane_structure_block_name(structure, b),
               blocks[b].volume);
    const double point[] = {500, 700, -1200};
    uint32_t block = 0;
    if (terrane_locate_points(terrane_model_volumes(m->blocks), point, 1, NULL, &block, error))
        return 2;
    printf("(500, 700, -1200) is in block %u\n", block);
    return 0;
}

int main(int argc, char** argv) {
    struct model m = {NULL, NULL, NULL, NULL, NULL};
    terrane_error* error = NULL;
    int status = make(&m, argc - 1, argv + 1, &error);
    if (status == 0) status = show(&m, &error);
    if (error) fprintf(stderr, "%s\n", terrane_error_message(error));
    terrane_error_free(error);
    terrane_model_free(m.blocks);
    terrane_mesh_free(m.mesh);
    terrane_cut_free(m.inside);
    terrane_arrangement_free(m.exact);
    terrane_surfaces_free(m.surfaces);
    return status;
}
