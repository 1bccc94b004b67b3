// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A user's program: it arranges, rounds, checks, verifies and measures two squares that cross and a
// closed tetrahedron, with the installed headers alone.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <terrane/advanced.hpp>

#if defined(CGAL_VERSION_NR) || defined(BOOST_VERSION) || defined(__GNU_MP_VERSION)
#error "an installed header includes CGAL, Boost or GMP"
#endif

namespace {

int failures = 0;

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "not so: %s\n", what);
    ++failures;
}

std::vector<terrane::Surface> surfaces() {
    return {{.name = "horizon",
             .role = terrane::Role::horizon,
             .vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
             .triangles = {{0, 1, 2}, {0, 2, 3}}},
            {.name = "fault",
             .role = terrane::Role::fault,
             .vertices = {{1, 0, -2}, {1, 5, -1}, {1, 2, 3}},
             .triangles = {{0, 1, 2}}},
            {.name = "block",
             .role = terrane::Role::boundary,
             .vertices = {{9, 0, 0}, {12, 0, 0}, {9, 3, 0}, {9, 0, 3}},
             .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}};
}

/// Tells whether some vertex has exactly these coordinates.
bool has_vertex(const terrane::Arrangement& a, const std::array<std::string, 3>& coordinates) {
    for (std::uint32_t v = 0; v < a.vertices.size(); ++v)
        if (a.coordinates(terrane::VertexId(v)) == coordinates) return true;
    return false;
}

/// Converts the exact result of the library to the claim that the verifier judges.
terrane::ArrangementClaim claim_of(const terrane::Arrangement& a) {
    terrane::ArrangementClaim claim;
    for (std::uint32_t v = 0; v < a.vertices.size(); ++v)
        claim.vertices.push_back(a.construction(terrane::VertexId(v)));
    claim.triangles = a.triangles;
    claim.parents_of = a.parents_of;
    claim.intersection_edges = a.intersection_edges;
    claim.degenerate = a.degenerate;
    claim.duplicates = a.inputs.duplicates;
    return claim;
}

void check_exact(const std::vector<terrane::Surface>& input, const terrane::Arrangement& a) {
    require(a.surfaces.size() == input.size(), "surfaces are those of the input");
    require(!a.intersection_edges.empty(), "the fault cuts the horizon");
    require(has_vertex(a, {"1", "4/5", "0"}), "the fault's side meets the horizon at (1, 4/5, 0)");
    require(a.nearest(terrane::VertexId(0)) == a.input_vertices()[0],
            "an input vertex is its own nearest double");
    require(terrane::verify_arrangement(input, claim_of(a)).empty(),
            "the verifier has no objection");
    const terrane::Arrangement copy = a;
    require(copy.coordinates(terrane::VertexId(0)) == a.coordinates(terrane::VertexId(0)),
            "a copy has the same points");
    const auto volumes = terrane::find_volumes(a);
    require(volumes && volumes->block_count() == 1, "there is one block");
    require(volumes && terrane::exact_volumes(a, *volumes).measures[1] == "9/2",
            "its volume is 9/2");
}

void check_rounded(const terrane::RoundedMesh& rounded) {
    const terrane::Mesh& mesh = rounded.mesh;
    require(rounded.report.clean, "the doubles are conforming");
    require(terrane::verify_conforming(mesh.vertices, mesh.triangles).empty(),
            "so says the verifier");
    require(terrane::find_regions(mesh).regions.size() == rounded.regions.size(),
            "the mesh has the regions that rounding found");
}

#ifdef WITH_TETGEN
void check_tetrahedra(const terrane::Mesh& mesh) {
    const auto tetrahedra = terrane::tetrahedralize(mesh, {.helper = TERRANE_TETGEN_HELPER}, {});
    require(tetrahedra && !tetrahedra->tetrahedra.empty(), "TetGen fills the mesh");
}
#endif

} // namespace

int main() {
    const auto input = surfaces();
    const auto checked = terrane::check(input);
    require(checked && !checked->clean() && !checked->contacts.empty(), "the input crosses itself");
    const auto rounded = terrane::arrange(input, {.search = terrane::Search::mixed})
                             .transform([&](terrane::Arrangement a) {
                                 check_exact(input, a);
                                 return a;
                             })
                             .and_then([](const auto& a) { return terrane::round_to_doubles(a); });
    require(rounded.ok(), rounded ? "" : rounded.error().sentence.c_str());
    if (rounded) {
        check_rounded(*rounded);
#ifdef WITH_TETGEN
        check_tetrahedra(rounded->mesh);
#endif
    }
    return failures == 0 ? 0 : 1;
}
