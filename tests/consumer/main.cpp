// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A program of someone else's: a fault that cuts a horizon, arranged.
#include <cstdio>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#ifdef WITH_TETGEN
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#endif

int main() {
    const std::vector<terrane::Surface> surfaces{
        {.name = "horizon",
         .role = terrane::Role::horizon,
         .vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
         .triangles = {{0, 1, 2}, {0, 2, 3}}},
        {.name = "fault",
         .role = terrane::Role::fault,
         .vertices = {{1, -1, -1}, {1, 5, -1}, {1, 2, 3}},
         .triangles = {{0, 1, 2}}}};

    const auto arrangement = terrane::arrange(surfaces, {}, {});
    if (!arrangement) {
        std::fprintf(stderr, "%s\n", arrangement.error().message().c_str());
        return 1;
    }
    std::printf("%zu triangles, %zu intersection edges\n", arrangement.value().triangles.size(),
                arrangement.value().intersection_edges.size());
    if (!terrane::verify_conforming(surfaces[0].vertices, surfaces[0].triangles).empty()) return 1;

#ifdef WITH_TETGEN
    const terrane::Mesh horizon{.surfaces = {{"horizon", terrane::Role::horizon}},
                                .vertices = surfaces[0].vertices,
                                .triangles = surfaces[0].triangles,
                                .surfaces_of = {{0, 1, 2}, {0, 0}},
                                .regions_of = {},
                                .parents_of = {},
                                .intersection_edges = {}};
    const auto tetrahedra = // the helper that is installed with the library that this links
        terrane::tetrahedralize(horizon, {.helper = TERRANE_TETGEN_HELPER}, {});
    if (!tetrahedra) {
        std::fprintf(stderr, "%s\n", tetrahedra.error().message().c_str());
        return 1;
    }
    std::printf("%zu tetrahedra\n", tetrahedra.value().tetrahedra.size());
#endif
    return arrangement.value().intersection_edges.empty() ? 1 : 0;
}
