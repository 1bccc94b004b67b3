// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Remeshes tetrahedra by CGAL's tetrahedral_isotropic_remeshing, with the triangles of all borders fixed: a yardstick for
// scripts/tetrahedra_table.py.
//   terrane_bench_remesh IN.mesh OUT.mesh EDGE_LENGTH [ITERATIONS]
// Both files are MEDIT. Their references of tetrahedra, from 1, are regions. Build it with NDEBUG, as the preset `bench` does.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <unordered_map>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_3/tet_soup_to_c3t3.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_triangulation_3.h>
#include <CGAL/tetrahedral_remeshing.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Tetrahedra = CGAL::Tetrahedral_remeshing::Remeshing_triangulation_3<Kernel>;

bool write_medit(const Tetrahedra& tetrahedra, const char* path) {
    std::FILE* const file = std::fopen(path, "w");
    if (file == nullptr) return false;
    std::unordered_map<Tetrahedra::Vertex_handle, std::size_t> number_of;
    std::fprintf(file, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n",
                 static_cast<std::size_t>(tetrahedra.number_of_vertices()));
    for (const auto v : tetrahedra.finite_vertex_handles()) {
        number_of.emplace(v, number_of.size() + 1);
        const auto& p = v->point();
        std::fprintf(file, "%.17g %.17g %.17g 0\n", p.x(), p.y(), p.z());
    }
    std::size_t count = 0;
    for (const auto c : tetrahedra.finite_cell_handles()) count += c->subdomain_index() != 0;
    std::fprintf(file, "Tetrahedra\n%zu\n", count);
    for (const auto c : tetrahedra.finite_cell_handles()) {
        if (c->subdomain_index() == 0) continue;
        for (int k = 0; k < 4; ++k) std::fprintf(file, "%zu ", number_of.at(c->vertex(k)));
        std::fprintf(file, "%d\n", static_cast<int>(c->subdomain_index()));
    }
    std::fprintf(file, "End\n");
    return std::fclose(file) == 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 4 || argc > 5) {
        std::fprintf(stderr, "usage: %s IN.mesh OUT.mesh EDGE_LENGTH [ITERATIONS]\n", argv[0]);
        return 2;
    }
    std::ifstream in(argv[1]);
    Tetrahedra tetrahedra;
    if (!in || !CGAL::build_triangulation_from_file<Tetrahedra, false>(in, tetrahedra)) {
        std::fprintf(stderr, "%s: no tetrahedra that CGAL can read\n", argv[1]);
        return 1;
    }
    const double length = std::atof(argv[3]);
    const unsigned iterations = argc == 5 ? static_cast<unsigned>(std::atoi(argv[4])) : 5;
    CGAL::tetrahedral_isotropic_remeshing(
        tetrahedra, length,
        CGAL::parameters::remesh_boundaries(false).number_of_iterations(iterations));
    if (!write_medit(tetrahedra, argv[2])) {
        std::fprintf(stderr, "%s: cannot be written\n", argv[2]);
        return 1;
    }
    return 0;
}
