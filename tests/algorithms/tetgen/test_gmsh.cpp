// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/files.hpp>

#include "support/impostor.hpp"
#include "support/paths.hpp"
#include "support/rounded.hpp"
#include "support/tetgen_cases.hpp"

using namespace terrane;
using namespace test_support;
using namespace tetgen_cases;
using impostor::Impostor;

namespace {

/// Fills the mesh by Gmsh and judges the result by the check of tetrahedra.
TetrahedralMesh by_gmsh(const Mesh& mesh, TetrahedraOptions options = {}) {
    options.mesher = Mesher::gmsh;
    const auto made = tetrahedralize(mesh, options, {});
    INFO((made ? std::string() : made.error().message()));
    REQUIRE(made);
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    CHECK(check_tetrahedra(made.value(), mesh, volumes.value()).violations.empty());
    CHECK(made.value().mesher == "Gmsh");
    CHECK(made.value().block_count == volumes.value().measures.size());
    // The triangles are faces, undivided, and no vertex of the mesh has moved.
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        CHECK(made.value().face_triangle[t] == t);
    CHECK(std::equal(mesh.vertices.begin(), mesh.vertices.end(), made.value().vertices.begin()));
    return made.value();
}

/// A cube, a smaller one inside, and a sheet in the space between that closes nothing.
Mesh nested_cubes_and_sheet() {
    MeshBuilder builder;
    builder.block(builder.surface("outer"), {0, 0, 0}, {1, 1, 1});
    builder.block(builder.surface("inner"), {0.25, 0.25, 0.25}, {0.5, 0.5, 0.5});
    builder.quad(builder.surface("sheet"), {0.6, 0.1, 0.1}, {0.6, 0.9, 0.1}, {0.6, 0.9, 0.9},
                 {0.6, 0.1, 0.9});
    return builder.mesh();
}

} // namespace

TEST_CASE("Gmsh: blocks in blocks, and a sheet that closes nothing", "[tetrahedra][gmsh]") {
    CHECK(by_gmsh(cube()).block_count == 2);
    CHECK(by_gmsh(nested_cubes_and_sheet()).block_count == 3);
    MeshBuilder sheet;
    sheet.quad(sheet.surface("sheet"), {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    CHECK(by_gmsh(sheet.mesh()).block_count == 1);
    CHECK(by_gmsh(Mesh{}, {.box = unit_box}).block_count == 1);
}

TEST_CASE("Gmsh: a real model, twice the same", "[tetrahedra][gmsh]") {
    const auto surfaces = read_surfaces(test_data() + "/ringmesh/split_cube.ml");
    REQUIRE(surfaces);
    const Mesh mesh = rounded(arranged(surfaces.value())).mesh;
    const TetrahedralMesh made = by_gmsh(mesh), again = by_gmsh(mesh);
    CHECK(made.block_count == 3);
    CHECK(made.vertices == again.vertices);
    CHECK(made.tetrahedra == again.tetrahedra);
}

TEST_CASE("Gmsh: an edge length gives more tetrahedra, but divides no triangle of a surface",
          "[tetrahedra][gmsh][once]") {
    const std::size_t few = by_gmsh(cube(), {.box = unit_box}).tetrahedra.size();
    CHECK(by_gmsh(cube(), {.box = unit_box, .edge_length = 0.25}).tetrahedra.size() > 4 * few);
}

TEST_CASE("Gmsh: it takes over where TetGen fails, and the result says why", "[tetrahedra][gmsh]") {
    const Impostor crashing("kill -SEGV $$");
    const auto made = tetrahedralize(cube(), {.helper = crashing.path()}, {});
    REQUIRE(made);
    CHECK(made.value().mesher == "Gmsh");
    CHECK(made.value().failure == "TetGen crashed (signal 11), in every way in which it was tried");
}

TEST_CASE("Gmsh: a failure of both has the sentences of both, and the places",
          "[tetrahedra][gmsh]") {
    const Impostor crashing("kill -SEGV $$"), giving_up("exit 1");
    const auto fails = [&](const TetrahedraOptions& options) {
        const auto made = tetrahedralize(nested_cubes_and_sheet(), options, {});
        REQUIRE_FALSE(made);
        return made.error();
    };
    const Error both = fails({.helper = crashing.path(), .gmsh_helper = giving_up.path()});
    CHECK(both.code == ErrorCode::unsupported);
    CHECK_THAT(both.sentence,
               Catch::StartsWith("TetGen crashed (signal 11), in every way in which it was tried; "
                                 "Gmsh gave up, in every way in which it was tried; the sharpest "
                                 "angle between triangles, 90 degrees, is here, the shortest edge, "
                                 "0.25, at ("));
    CHECK_FALSE(both.place.empty());
    // Without the second helper it is TetGen's failure alone.
    const Error first = fails({.helper = crashing.path(), .gmsh_helper = "/nowhere"});
    CHECK_THAT(first.sentence, !Catch::Contains("Gmsh"));
    const Error alone = fails({.mesher = Mesher::tetgen, .helper = crashing.path()});
    CHECK(alone.message() == first.message());
    // Gmsh alone needs its helper, and no other.
    const Error missing = fails({.mesher = Mesher::gmsh, .gmsh_helper = "/nowhere"});
    CHECK(missing.code == ErrorCode::cannot_open);
    CHECK(missing.place == "/nowhere");
    by_gmsh(cube(), {.helper = "/nowhere"});
}

TEST_CASE("Gmsh: what it cannot do is refused by name", "[tetrahedra][gmsh]") {
    const auto refused = [](TetrahedraOptions options) {
        options.mesher = Mesher::gmsh;
        const auto made = tetrahedralize(cube(), options, {});
        REQUIRE_FALSE(made);
        CHECK(made.error().code == ErrorCode::bad_option);
        return made.error().sentence;
    };
    CHECK_THAT(refused({.radius_edge_ratio = 1.5}), Catch::StartsWith("Gmsh has no bound"));
    CHECK_THAT(refused({.block_sizes = {{BlockId{1}, 0.5}}}),
               Catch::StartsWith("Gmsh has no sizes"));
    CHECK_THAT(refused({.surface_sizes = {{SurfaceId{0}, 0.5}}}),
               Catch::StartsWith("Gmsh has no sizes"));
    CHECK_THAT(refused({.split_surfaces = true}), Catch::StartsWith("Gmsh has no sizes"));
}
