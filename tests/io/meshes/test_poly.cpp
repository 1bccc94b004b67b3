// SPDX-License-Identifier: LGPL-3.0-or-later
//
// TetGen's own reader reads back .poly and .smesh files, and TetGen fills the meshes.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

#include <tetgen.h>

#include "support/files.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/files.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

Mesh faulted() {
    const std::vector<Surface> surfaces{box({0, 0, 0}, {8, 8, 8}, "box"),
                                        level(3, -1, -1, 9, 9, "base"),
                                        quad({2, -1, -1}, {2, 9, -1}, {5, 9, 9}, {5, -1, 9}, "F1")};
    return mesh_of(surfaces);
}

/// Reads `path`, named without its extension, with TetGen's reader.
void load(tetgenio& io, const std::filesystem::path& path) {
    auto name = path.string();
    REQUIRE(io.load_poly(name.data()));
}

void check_points(const tetgenio& io, const Mesh& mesh) {
    REQUIRE(io.numberofpoints == static_cast<int>(mesh.vertices.size()));
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const double* p = io.pointlist + 3 * v;
        CHECK(same_bits({p[0], p[1], p[2]}, mesh.vertices[v]));
    }
}

void check_facets(const tetgenio& io, const Mesh& mesh, const std::vector<int>& markers) {
    REQUIRE(io.numberoffacets == static_cast<int>(mesh.triangles.size()));
    CHECK(io.firstnumber == 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& facet = io.facetlist[t];
        REQUIRE(facet.numberofpolygons == 1);
        CHECK(facet.numberofholes == 0);
        REQUIRE(facet.polygonlist[0].numberofvertices == 3);
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(facet.polygonlist[0].vertexlist[i] == static_cast<int>(mesh.triangles[t][i]) + 1);
        CHECK(io.facetmarkerlist[t] == markers[t]);
    }
}

/// Sums the volumes of TetGen's tetrahedra by their attribute.
std::map<int, double> volumes_of(const tetgenio& out) {
    std::map<int, double> volumes;
    for (int t = 0; t < out.numberoftetrahedra; ++t) {
        const auto corner = [&](int i) {
            return out.pointlist + 3 * (out.tetrahedronlist[4 * t + i] - out.firstnumber);
        };
        const double* o = corner(0);
        double m[3][3];
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) m[i][k] = corner(i + 1)[k] - o[k];
        const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        volumes[static_cast<int>(std::lround(out.tetrahedronattributelist[t]))] +=
            std::fabs(det) / 6;
    }
    return volumes;
}

} // namespace

TEST_CASE("TetGen: .poly and .smesh read back by its own reader", "[io][poly]") {
    TemporaryFolder folder;
    auto mesh = awkward_mesh();
    mesh.surfaces[0].name = "top # reservoir"; // in a comment, which TetGen must skip
    const std::vector<BlockPoint> points{{{0.1, -2, 3e-300}, BlockId(7)},
                                         {{1.0 / 3, 5, 6}, BlockId(8)}};
    for (const std::string extension : {"poly", "smesh"}) {
        INFO(extension);
        REQUIRE(message_of(write_mesh(mesh, folder / ("a_" + extension + "." + extension),
                                      {.block_points = points})) == "no error");
        tetgenio io;
        load(io, folder / ("a_" + extension));
        check_points(io, mesh);
        check_facets(io, mesh, {1, 4, 2, 3});
        CHECK(io.numberofholes == 0);
        REQUIRE(io.numberofregions == 2);
        for (std::size_t r = 0; r < 2; ++r) {
            const double* line = io.regionlist + 5 * r;
            CHECK(same_bits({line[0], line[1], line[2]}, points[r].place));
            CHECK(line[3] == points[r].block);
        }
    }
}

TEST_CASE("TetGen: it fills the blocks from points inside them", "[io][poly]") {
    TemporaryFolder folder;
    const Mesh mesh = faulted();
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    REQUIRE(volumes.value().block_count() == 4);
    const auto points = block_points(mesh, volumes.value());
    REQUIRE(points);
    REQUIRE(points.value().size() == 4);
    for (const std::string extension : {"poly", "smesh"}) {
        const auto file = "b_" + extension + "." + extension;
        REQUIRE(write_mesh(mesh, folder / file, {.block_points = points.value()}));
        tetgenio in, out;
        load(in, folder / ("b_" + extension));
        char switches[] = "pAQ";
        tetgenbehavior behavior;
        REQUIRE(behavior.parse_commandline(switches));
        tetrahedralize(&behavior, &in, &out);
        const auto found = volumes_of(out);
        REQUIRE(found.size() == 4);
        for (const auto& [block, volume] : found) {
            REQUIRE(block >= 1);
            CHECK(volume == Approx(volumes.value().measures[static_cast<std::size_t>(block)]));
        }
    }
}
