// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares tetrahedra as TetGen makes them with blocks as find_volumes finds them.
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "support/filled.hpp"
#include "support/paths.hpp"
#include "support/points.hpp"
#include "support/solids.hpp"
#include <terrane/io/files.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Checks the tetrahedra; returns the number of blocks whose volume equals exactly that of their
/// tetrahedra.
std::size_t check_and_count_equal(const Filled& f) {
    const auto report = check_tetrahedra(f.tetrahedra, f.mesh, f.volumes);
    CHECK(text_of(report.violations) == "");
    REQUIRE(report.volumes.size() == f.volumes.measures.size());
    CHECK(report.volumes[0].block == report.volumes[0].tetrahedra); // the outside
    CHECK(report.volumes[0].equal);
    std::size_t equal = 0;
    for (std::size_t v = 1; v < report.volumes.size(); ++v) {
        CHECK(report.volumes[v].block == f.volumes.measures[v]);
        CHECK((report.volumes[v].difference == 0) == report.volumes[v].equal);
        equal += report.volumes[v].equal ? 1 : 0;
    }
    return equal;
}

const std::vector<Surface> faulted{box({0, 0, 0}, {8, 8, 8}, "box"), level(3, -1, -1, 9, 9, "base"),
                                   level(5, -1, -1, 9, 9, "top"),
                                   quad({2, -1, -1}, {2, 9, -1}, {5, 9, 9}, {5, -1, 9}, "F1"),
                                   quad({6, 1, 1}, {6, 4, 1}, {6, 4, 7}, {6, 1, 7}, "tip")};

} // namespace

TEST_CASE("tetrahedra: their blocks are those of the mesh, with numbers and exact volumes",
          "[tetrahedra]") {
    CHECK(check_and_count_equal(fill({cube(0, 4), cube(1, 2), box({2.5, 2, 2}, {3, 3, 3})})) == 3);
    CHECK(check_and_count_equal(fill({cube(0, 2), cube(1, 3)})) == 3);
    // These two make TetGen fail when it sorts the points.
    CHECK(check_and_count_equal(fill({cube(0, 2), cube(1, 3), box({2, 0, 0}, {3, 1, 1})})) == 4);
    CHECK(check_and_count_equal(fill({cube(0, 4), cube(1, 2), box({2, 2, 2}, {3, 3, 3})})) == 3);
    CHECK(check_and_count_equal(fill({torus({0, 0, 0}, 4, 1, 8), torus({4, 0, 0}, 4, 1, 8, 1)})) ==
          2);
    const Filled f = fill(faulted);
    CHECK(f.volumes.block_count() == 6);
    CHECK(check_and_count_equal(f) == 6);
}

TEST_CASE("tetrahedra: with added vertices volumes stay within the bound", "[tetrahedra]") {
    const Filled f = fill(faulted, {.edge_length = 1.7});
    CHECK(f.tetrahedra.tetrahedra.size() > 500);
    check_and_count_equal(f);
    const auto report = check_tetrahedra(f.tetrahedra, f.mesh, f.volumes);
    for (const BlockVolume& v : report.volumes) CHECK(v.bound < 1e-10);
}

TEST_CASE("tetrahedra: random models, two methods agree", "[tetrahedra]") {
    Random random(21);
    std::size_t blocks = 0;
    for (int i = 0; i < 25; ++i) {
        std::vector<Surface> model;
        const auto number = [&] { return double(random_int(random, -8, 8)); };
        for (int k = random_int(random, 1, 3); k > 0; --k)
            model.push_back(tetrahedron(point_of(number), point_of(number), point_of(number),
                                        point_of(number)));
        model.push_back(octahedron(point_of(number), 5));
        model.push_back(level(number(), -9, -9, 9, 9));
        const Mesh mesh = mesh_of(model);
        const auto volumes = find_volumes(mesh);
        REQUIRE(volumes);
        auto made = tetrahedralize(mesh, {}, {});
        INFO((made ? std::string() : made.error().message()));
        REQUIRE(made);
        const Filled f{mesh, volumes.value(), std::move(made).value(), {}, {}, {}};
        check_and_count_equal(f);
        blocks += f.volumes.block_count();
    }
    CHECK(blocks > 60);
}

TEST_CASE("tetrahedra: two methods agree on a real model", "[tetrahedra][once]") {
    const auto surfaces = read_surfaces(test_data() + "/ringmesh/modelA2.ml");
    REQUIRE(surfaces);
    const Filled f = fill(surfaces.value());
    CHECK(f.volumes.block_count() == 12);
    check_and_count_equal(f);
}

TEST_CASE("check_tetrahedra: violations are counted, with a sentence about the first",
          "[tetrahedra]") {
    Filled f = fill(faulted);
    auto& tetrahedra = f.tetrahedra.tetrahedra;
    for (const std::size_t t : {3, 5, 8}) std::swap(tetrahedra[t][0], tetrahedra[t][1]);
    const auto found = violations_of(f);
    REQUIRE_FALSE(found.empty());
    CHECK(found[0].defect == TetrahedraDefect::no_volume);
    CHECK(found[0].count == 3);
    CHECK(found[0].first.find("tetrahedron 3 at (") == 0);
    CHECK(message(found[0]) == found[0].first + "; 2 more of this kind (no_volume)");
    CHECK(message({TetrahedraDefect::open_face, 1, "alone"}) == "alone");
    std::set<std::string_view> names;
    for (auto defect = TetrahedraDefect::unusable_lists; defect <= TetrahedraDefect::wrong_volume;
         defect = static_cast<TetrahedraDefect>(static_cast<int>(defect) + 1))
        names.insert(name_of(defect));
    CHECK(names.size() == 18);
    CHECK(name_of(TetrahedraDefect::wrong_volume) == "wrong_volume");
    CHECK(name_of(TetrahedraDefect::missing_vertex) == "missing_vertex");
    CHECK(name_of(TetrahedraDefect::folded_faces) == "folded_faces");
}

TEST_CASE("adopt_volume_numbers: disagreement is an error with a place", "[tetrahedra]") {
    const Filled good = fill(faulted);
    Volumes merged = good.volumes;
    for (auto& sides : merged.of_sides)
        for (std::uint32_t& v : sides) v = v == 2 ? 1 : v;
    TetrahedralMesh tetrahedra = good.tetrahedra;
    const auto status = adopt_volume_numbers(merged, tetrahedra);
    REQUIRE_FALSE(status);
    CHECK(status.error().code == ErrorCode::internal);
    CHECK(status.error().place.find("triangle ") == 0);
    Volumes none;
    none.of_sides.assign(good.mesh.triangles.size(), {0, 0});
    CHECK_FALSE(adopt_volume_numbers(none, tetrahedra));
    CHECK(adopt_volume_numbers(good.volumes, tetrahedra));
    CHECK(tetrahedra.block_of == good.tetrahedra.block_of);
}
