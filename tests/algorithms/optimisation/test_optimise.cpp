// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/optimise.hpp>

#include "support/cubes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace test_support;

namespace {

/// Checks the promises about the tetrahedra, but for their shapes. `beside_wall`: the blocks next
/// to faces that are not on the box.
void check_still_fills(const TetrahedralMesh& before, const TetrahedralMesh& after,
                       const std::vector<std::uint32_t>& beside_wall = {1, 2}) {
    for (const Cell& c : after.tetrahedra) {
        const auto p = corners_of(after, c);
        CHECK(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }
    for (const std::uint32_t block : {1U, 2U})
        CHECK(six_volumes(after, block) == six_volumes(before, block));
    REQUIRE(after.faces.size() == before.faces.size());
    std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> beside;
    for (std::size_t t = 0; t < after.tetrahedra.size(); ++t)
        for (unsigned k = 0; k < 4; ++k) {
            const Cell& c = after.tetrahedra[t];
            std::array<std::uint32_t, 3> face{c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
            std::sort(face.begin(), face.end());
            beside[face].push_back(after.block_of[t]);
        }
    for (std::size_t f = 0; f < after.faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(after.vertices[after.faces[f][k]] == before.vertices[before.faces[f][k]]);
        std::array<std::uint32_t, 3> face{after.faces[f][0], after.faces[f][1], after.faces[f][2]};
        std::sort(face.begin(), face.end());
        const auto at = beside.find(face);
        REQUIRE(at != beside.end());
        auto blocks = at->second;
        std::sort(blocks.begin(), blocks.end());
        if (after.face_triangle[f] == UINT32_MAX)
            CHECK(blocks.size() == 1);
        else
            CHECK(blocks == beside_wall);
        beside.erase(at);
    }
    for (const auto& [face, blocks] : beside) {
        REQUIRE(blocks.size() == 2);
        CHECK(blocks[0] == blocks[1]);
    }
}

TEST_CASE("optimise: tetrahedra fill the same space, and the worst never gets worse",
          "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const int wall = seed % 3 == 0 ? 0 : 2;
        const TetrahedralMesh before = Cubes(4, wall, 0.3 + 0.05 * double(seed % 5), seed).mesh;
        TetrahedralMesh after = before;
        const auto report = optimise(after);
        REQUIRE(report);
        check_still_fills(before, after);
        const auto was = sines(before), is = sines(after);
        CHECK(is[0] >= was[0]);
        CHECK(report->before.quality == Approx(least_quality(before)).epsilon(1e-9));
        CHECK(report->after.quality == Approx(least_quality(after)).epsilon(1e-9));
        CHECK(report->after.quality >= report->before.quality);
        const auto shape = shape_of(after).dihedral;
        CHECK(report->after.least_angle == Approx(shape.least));
        CHECK(report->after.largest_angle == Approx(shape.largest));
        const double bad = std::sin(bad_angle * std::numbers::pi / 180);
        const auto count = [&](const std::vector<double>& all) {
            return std::lower_bound(all.begin(), all.end(), bad) - all.begin();
        };
        CHECK(20 * count(is) <= count(was) + 20);
    }
}

TEST_CASE("optimise: the mean ratio of needles with good angles is raised", "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        TetrahedralMesh mesh = Cubes(8, 0, 0.45, seed).mesh;
        REQUIRE(optimise(mesh));
        CHECK(sines(mesh)[0] > std::sin(bad_angle * std::numbers::pi / 180));
        double least = 1;
        for (const Cell& c : mesh.tetrahedra)
            least = std::min(least, mean_ratio(corners_of(mesh, c)));
        CHECK(least >= 0.25);
    }
}

TEST_CASE("optimise: a sheet that ends inside of a block stays", "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        TetrahedralMesh before = Cubes(6, 3, 0.45, seed).mesh;
        for (std::uint32_t& block : before.block_of) block = 1;
        std::vector<Triangle> faces;
        std::vector<std::uint32_t> triangles;
        before.surfaces_of = {};
        for (std::size_t f = 0; f < before.faces.size(); ++f) { // those of the wall with x <= 3
            const Triangle& face = before.faces[f];
            const bool inside = before.face_triangle[f] != UINT32_MAX;
            if (inside && std::any_of(face.begin(), face.end(),
                                      [&](std::uint32_t v) { return before.vertices[v].x > 3; }))
                continue;
            faces.push_back(face);
            triangles.push_back(before.face_triangle[f]);
            before.surfaces_of.push_back(std::array<std::uint32_t, 1>{inside ? 0U : 1U});
        }
        before.faces = faces;
        before.face_triangle = triangles;
        TetrahedralMesh after = before;
        REQUIRE(optimise(after));
        check_still_fills(before, after, {1, 1});
    }
}

TEST_CASE("optimise: the same tetrahedra give the same result, at any scale", "[optimisation]") {
    const TetrahedralMesh before = Cubes(4, 2, 0.4, 5).mesh;
    TetrahedralMesh once = before, twice = before, large = before;
    for (Point3& p : large.vertices)
        p = {std::ldexp(p.x, 900), std::ldexp(p.y, 900), std::ldexp(p.z, 900)};
    REQUIRE(optimise(once));
    REQUIRE(optimise(twice));
    REQUIRE(optimise(large));
    CHECK(once.vertices == twice.vertices);
    CHECK(once.tetrahedra == twice.tetrahedra);
    CHECK(once.tetrahedra == large.tetrahedra);
    for (std::size_t v = 0; v < once.vertices.size(); ++v)
        CHECK(std::ldexp(once.vertices[v].x, 900) == large.vertices[v].x);
}

TEST_CASE("optimise: any number of threads gives the same result", "[optimisation]") {
    const TetrahedralMesh before = Cubes(6, 3, 0.45, 7).mesh;
    TetrahedralMesh one = before;
    const auto report = optimise(one, {.wanted_angle = 40}, {.threads = 1});
    REQUIRE(report);
    CHECK(report->inserted + report->moved > 100);
    for (const unsigned threads : {2U, 3U, 7U}) {
        TetrahedralMesh several = before;
        const auto again = optimise(several, {.wanted_angle = 40}, {.threads = threads});
        REQUIRE(again);
        CHECK(several.vertices == one.vertices);
        CHECK(several.tetrahedra == one.tetrahedra);
        CHECK(several.block_of == one.block_of);
        CHECK(again->moved == report->moved);
    }
}

TEST_CASE("optimise: a limit of effort ends the work early, with a sound result",
          "[optimisation]") {
    const TetrahedralMesh before = Cubes(6, 3, 0.45, 7).mesh;
    TetrahedralMesh whole = before;
    const auto all = optimise(whole, {.wanted_angle = 40}, {.threads = 1});
    REQUIRE(all);
    CHECK_FALSE(all->is_cut_short);
    const double least_sine = sines(before)[0];
    const std::vector<double> was = qualities(before);
    for (const std::size_t most : {std::size_t{1}, all->effort / 16, all->effort / 4}) {
        TetrahedralMesh one = before, two = before;
        const OptimiseOptions options{.wanted_angle = 40, .max_effort = most};
        const auto report = optimise(one, options, {.threads = 1});
        REQUIRE(report);
        REQUIRE(optimise(two, options, {.threads = 2}));
        CHECK(report->is_cut_short);
        CHECK(report->untried > 0);
        CHECK(report->effort >= most);
        // The proposals of a batch are all measured.
        CHECK(report->effort < all->effort / 2);
        CHECK(one.vertices == two.vertices);
        CHECK(one.tetrahedra == two.tetrahedra);
        CHECK(one.block_of == two.block_of);
        check_still_fills(before, one);
        CHECK(sines(one)[0] >= least_sine);
        CHECK(qualities(one) >= was); // from the worst one on
    }
}

TEST_CASE("optimise: where doubles are no help, tetrahedra stay as they are", "[optimisation]") {
    const TetrahedralMesh good = Cubes(3, 1, 0.4, 3).mesh;
    TetrahedralMesh flat = good; // flatter than the rounding of their volumes
    for (Point3& p : flat.vertices) p.z = std::ldexp(p.z, -60);
    TetrahedralMesh far = good; // too large for products, next to which one is too small
    for (Point3& p : far.vertices)
        p = {std::ldexp(p.x, -800), std::ldexp(p.y, -800), std::ldexp(p.z, -800)};
    far.vertices.push_back({0x1p1000, 0, 0});
    for (const TetrahedralMesh& before : {flat, far}) {
        TetrahedralMesh after = before;
        const auto report = optimise(after);
        REQUIRE(report);
        CHECK(after.tetrahedra == before.tetrahedra);
        for (std::size_t v = 0; v < after.vertices.size(); ++v)
            CHECK(after.vertices[v] == before.vertices[v]);
    }
}

TEST_CASE("optimise: places are those that the mesh can have, among denormals as well",
          "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        TetrahedralMesh before = Cubes(4, 2, 0.4, seed).mesh;
        for (Point3& p : before.vertices) // multiples of 2^-1074, 64 to an edge
            p = {std::ldexp(p.x, -1068), std::ldexp(p.y, -1068), std::ldexp(p.z, -1068)};
        bool sound = true; // rounding may have turned one over
        for (const Cell& c : before.tetrahedra) {
            const auto p = corners_of(before, c);
            sound = sound && orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive;
        }
        if (!sound) continue;
        TetrahedralMesh after = before;
        const auto report = optimise(after, {.wanted_angle = 40});
        REQUIRE(report);
        CHECK(report->moved > 0);
        check_still_fills(before, after);
        for (TetrahedralMesh* mesh : {&before, &after})
            for (Point3& p : mesh->vertices)
                p = {std::ldexp(p.x, 1068), std::ldexp(p.y, 1068), std::ldexp(p.z, 1068)};
        CHECK(report->after.quality == Approx(least_quality(after)).epsilon(1e-9));
        CHECK(least_quality(after) >= least_quality(before));
    }
}

TEST_CASE("optimise: the outside stays as it is on request", "[optimisation]") {
    TetrahedralMesh before = Cubes(4, 2, 0.45, 9).mesh;
    for (std::uint32_t& block : before.block_of) block = block == 2 ? 0 : 1;
    TetrahedralMesh after = before;
    REQUIRE(optimise(after, {.outside = false}));
    const auto outside = [](const TetrahedralMesh& mesh) {
        std::multiset<std::vector<std::array<double, 3>>> all;
        for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
            if (mesh.block_of[t] != 0) continue;
            std::vector<std::array<double, 3>> corners;
            for (const std::uint32_t v : mesh.tetrahedra[t])
                corners.push_back({mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z});
            std::sort(corners.begin(), corners.end());
            all.insert(corners);
        }
        return all;
    };
    CHECK(outside(after) == outside(before));
    CHECK(after.vertices != before.vertices);
}

TEST_CASE("optimise: good tetrahedra stay as they are", "[optimisation]") {
    const TetrahedralMesh before = Cubes(3, 1, 0, 1).mesh;
    TetrahedralMesh after = before;
    const auto report = optimise(after);
    REQUIRE(report);
    CHECK(after.tetrahedra == before.tetrahedra);
    CHECK(after.vertices == before.vertices);
    CHECK(report->removed_edges + report->removed_faces + report->moved + report->contracted +
              report->inserted ==
          0);
}

TEST_CASE("optimise: an edge with three flat tetrahedra around it goes", "[optimisation]") {
    TetrahedralMesh mesh;
    mesh.vertices = {{0, 0, -0.5}, {0, 0, 0.5}};
    mesh.vertices[0].z = -0.4;
    mesh.vertices[1].z = 0.4;
    for (int k = 0; k < 3; ++k)
        mesh.vertices.push_back({std::cos(2.1 * k) * 4, std::sin(2.1 * k) * 4, 0});
    mesh.tetrahedra = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 2}};
    mesh.block_of = {1, 1, 1};
    mesh.block_count = 2;
    for (const Cell& c : mesh.tetrahedra) {
        const auto p = corners_of(mesh, c);
        REQUIRE(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
        for (const std::uint32_t end : {c[0], c[1]}) {
            mesh.faces.push_back({end, c[2], c[3]});
            mesh.face_triangle.push_back(UINT32_MAX);
            mesh.surfaces_of.push_back(std::array<std::uint32_t, 1>{0});
        }
    }
    mesh.surfaces = {{"box", Role::boundary}};
    const double before = sines(mesh)[0];
    TetrahedralMesh after = mesh;
    const auto report = optimise(after, {.wanted_angle = 50});
    REQUIRE(report);
    CHECK(sines(after)[0] >= before);
    check_still_fills(mesh, after);
}

TEST_CASE("optimise: on request no tetrahedron is larger than the largest before",
          "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const TetrahedralMesh before = Cubes(4, 2, 0.45, seed).mesh;
        const auto largest = [](const TetrahedralMesh& mesh) {
            double most = 0;
            for (const Cell& c : mesh.tetrahedra) {
                TetrahedralMesh one;
                one.vertices = mesh.vertices;
                one.tetrahedra = {c};
                one.block_of = {1};
                most = std::max(most, six_volumes(one, 1).get_d());
            }
            return most;
        };
        TetrahedralMesh free = before, bounded = before;
        REQUIRE(optimise(free));
        REQUIRE(optimise(bounded, {.may_grow = false}));
        CHECK(largest(bounded) <= largest(before) * (1 + 1e-12));
        check_still_fills(before, bounded);
    }
}

TEST_CASE("optimise: refuses options that make no sense, and stops on request", "[optimisation]") {
    TetrahedralMesh mesh = Cubes(3, 0, 0.4, 2).mesh;
    const TetrahedralMesh before = mesh;
    for (const double angle : {0.0, -1.0, 60.0, std::nan("")}) {
        const auto refused = optimise(mesh, {.wanted_angle = angle});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::bad_option);
    }
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    const auto stopped = optimise(mesh, {}, run);
    REQUIRE_FALSE(stopped);
    CHECK(stopped.error().code == ErrorCode::interrupted);
    CHECK(mesh.tetrahedra == before.tetrahedra);
    TetrahedralMesh broken = mesh;
    broken.tetrahedra[5][2] = static_cast<std::uint32_t>(broken.vertices.size());
    CHECK(optimise(broken).error().code == ErrorCode::bad_index);
    broken = mesh;
    broken.block_of.pop_back();
    CHECK(optimise(broken).error().code == ErrorCode::bad_index);
    mesh.twins.push_back({0, 1});
    CHECK(optimise(mesh).error().code == ErrorCode::bad_option);
}

} // namespace
} // namespace terrane
