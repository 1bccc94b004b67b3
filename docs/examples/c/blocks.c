// SPDX-License-Identifier: LGPL-3.0-or-later
//
// blocks: makes a model of three surfaces in a box, lists its blocks, and says in which one a point lies.
#include <stdint.h>
#include <stdio.h>

#include <terrane/terrane.h>

// The keys of a project file; the surfaces are in the current folder.
static const char project[] =
    "{\"format\": \"terrane-project 1\","
    " \"surfaces\": [{\"file\": \"top.ts\"}, {\"file\": \"base.ts\"}, {\"file\": \"fault.ts\"}],"
    " \"volume_of_interest\": {\"box\": {\"low\": [0, 0, -1700], \"high\": [2000, 1500, -700]}},"
    " \"seal\": 20, \"outputs\": {\"blocks\": \"vtp\"}}";

static terrane_code show(const terrane_model* model, terrane_error** error) {
    const terrane_structure* structure = terrane_model_structure(model);
    size_t count = 0;
    const terrane_model_block* blocks = terrane_structure_blocks(structure, &count);
    for (size_t b = 1; b < count; ++b) // 0 is the outside
        printf("block %zu, %s: volume %.6g\n", b, terrane_structure_block_name(structure, b),
               blocks[b].volume);
    const double point[] = {500, 700, -1200};
    uint32_t block = 0;
    const terrane_code code =
        terrane_locate_points(terrane_model_volumes(model), point, 1, NULL, &block, error);
    if (code == TERRANE_OK) printf("(500, 700, -1200) is in block %u\n", block);
    return code;
}

int main(void) {
    terrane_built* built = NULL;
    terrane_error* error = NULL;
    if (terrane_build(project, NULL, NULL, NULL, &built, &error) == TERRANE_OK)
        show(terrane_built_model(built), &error);
    const int status = error ? 2 : 0;
    if (error) fprintf(stderr, "%s\n", terrane_error_message(error));
    terrane_error_free(error);
    terrane_built_free(built);
    return status;
}
