// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/bad_tetrahedra.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/pipeline/detail/refinement.hpp>

using namespace terrane;

namespace {

/// A tetrahedron over the triangle (0, 0, 0), (2, 0, 0), (1, y, 0), whose fourth corner is above
/// (1, 0.4 y, 0).
TetrahedralMesh flat_one(double height, double y = 2) {
    TetrahedralMesh mesh;
    mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {1, y, 0}, {1, .4 * y, height}};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    return mesh;
}

/// Adds a face on a surface.
void add_face(TetrahedralMesh& mesh, Triangle face, std::uint32_t surface = 0) {
    mesh.faces.push_back(face);
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{surface});
}

BadTetrahedron only_one(const TetrahedralMesh& mesh) {
    const auto bad = bad_tetrahedra(mesh);
    REQUIRE(bad.size() == 1);
    return bad.front();
}

} // namespace

TEST_CASE("bad tetrahedra: the least angle, and whether it is below ten degrees", "[tetrahedra]") {
    // The angle at the edge from 0 to 1 is that at (1, 0) between the lines to 2 and to 3.
    const auto height_for = [](double degrees) {
        return .8 * std::tan(degrees * std::numbers::pi / 180);
    };
    CHECK(bad_tetrahedra(flat_one(height_for(40))).empty());
    const double heights[] = {height_for(9.5), height_for(3), height_for(1e-3)};
    const double angles[] = {9.5, 3, 1e-3};
    for (int i = 0; i < 3; ++i) {
        auto mesh = flat_one(heights[i]);
        const BadTetrahedron bad = only_one(mesh);
        CHECK(bad.number == 0);
        CHECK(bad.least <= angles[i] * (1 + 1e-9));
        CHECK(bad.cause == BadCause::other);
        CHECK_FALSE(bad.is_at_input_angle);
    }
}

TEST_CASE("bad tetrahedra: each cause, and the first that applies", "[tetrahedra]") {
    auto mesh = flat_one(.1);
    add_face(mesh, {0, 2, 1});
    CHECK(only_one(mesh).cause == BadCause::other);
    SECTION("a gap: all four corners are on surfaces") {
        mesh.vertices.insert(mesh.vertices.end(), {{-9, .8, 9}, {9, .8, 9}});
        add_face(mesh, {3, 4, 5});
        CHECK(only_one(mesh).cause == BadCause::gap);
        CHECK_FALSE(only_one(mesh).is_at_input_angle);
    }
    SECTION("two faces on surfaces, with the angle between them") {
        add_face(mesh, {0, 1, 3});
        CHECK(only_one(mesh).cause == BadCause::input_angle);
        CHECK(only_one(mesh).is_at_input_angle);
    }
    SECTION("two faces on surfaces, but the angle between them is not bad") {
        mesh.vertices[3] = {1, -.5, .05}; // beyond the edge from 0 to 1: there it is obtuse
        add_face(mesh, {0, 1, 3});
        CHECK(only_one(mesh).cause == BadCause::gap);
        CHECK_FALSE(only_one(mesh).is_at_input_angle);
    }
}

TEST_CASE("bad tetrahedra: a thin triangle of a surface", "[tetrahedra]") {
    auto mesh = flat_one(.05, .1); // the triangle has angles of 5.7 degrees
    mesh.vertices[3] = {1, .02, .002};
    add_face(mesh, {0, 2, 1});
    // Its sides are curves, as they have one face each: no mesh has a better angle there.
    CHECK(only_one(mesh).cause == BadCause::thin_triangle);
    CHECK(only_one(mesh).is_at_input_angle);
    // With neighbours of the same surface they are none, and smaller triangles help.
    mesh.vertices.insert(mesh.vertices.end(), {{1, -3, 0}, {3, 3, 0}, {-1, 3, 0}});
    add_face(mesh, {0, 1, 4});
    add_face(mesh, {1, 2, 5});
    add_face(mesh, {2, 0, 6});
    CHECK(only_one(mesh).cause == BadCause::thin_triangle);
    CHECK_FALSE(only_one(mesh).is_at_input_angle);
    // If the neighbours are of another surface, they are curves again.
    mesh.surfaces_of = {};
    for (const std::uint32_t surface : {0, 1, 1, 1})
        mesh.surfaces_of.push_back(std::vector<std::uint32_t>{surface});
    CHECK(only_one(mesh).is_at_input_angle);
}

TEST_CASE("bad tetrahedra: one beside an input angle is told from one that is apart",
          "[tetrahedra]") {
    auto mesh = flat_one(.1);
    add_face(mesh, {0, 2, 1});
    add_face(mesh, {0, 1, 3});
    // A second one has corner 1 in common with it, a third one has no corner in common with any.
    mesh.vertices.insert(mesh.vertices.end(), {{4, 0, 0}, {3, 2, 0}, {3, .8, .1}});
    mesh.tetrahedra.push_back({1, 4, 5, 6});
    mesh.vertices.insert(mesh.vertices.end(), {{3, 2, 5}, {2, 4, 5}, {2, 2.8, 5.1}, {1, 4, 5}});
    mesh.tetrahedra.push_back({7, 10, 8, 9});
    const auto bad = bad_tetrahedra(mesh);
    REQUIRE(bad.size() == 3);
    CHECK(bad[0].is_at_input_angle);
    CHECK(bad[1].is_at_input_angle);
    CHECK_FALSE(bad[2].is_at_input_angle);
}

TEST_CASE("misshapen tetrahedra: a low mean ratio without a bad angle", "[tetrahedra]") {
    // Over an equilateral triangle with sides of 1: all angles are 60 degrees and more.
    const double y = std::sqrt(3.) / 2;
    TetrahedralMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {.5, y, 0}, {.5, y / 3, 9}};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    const double volume = y * 9 / 6, squares = 3 + 3 * (81 + 1 / 3.);
    const double ratio = 12 * std::pow(3 * volume, 2 / 3.) / squares;
    CHECK(bad_tetrahedra(mesh).empty());
    CHECK(misshapen_tetrahedra(mesh, ratio * (1 - 1e-9)).empty());
    CHECK(misshapen_tetrahedra(mesh, ratio * (1 + 1e-9)) == std::vector<std::uint32_t>{0});
    SECTION("a bad one does not count twice") {
        mesh.vertices.insert(mesh.vertices.end(),
                             {{20, 0, 0}, {22, 0, 0}, {21, 2, 0}, {21, .8, .01}});
        mesh.tetrahedra.insert(mesh.tetrahedra.begin(), {4, 5, 6, 7});
        CHECK(bad_tetrahedra(mesh).size() == 1);
        CHECK(misshapen_tetrahedra(mesh, .25) == std::vector<std::uint32_t>{1});
    }
    SECTION("a tetrahedron at a bad angle of the surfaces does not count") {
        mesh.vertices.insert(mesh.vertices.end(), {{-2, .05, 0}, {-2, 0, 0}});
        add_face(mesh, {0, 4, 5}); // its sides are curves
        CHECK(misshapen_tetrahedra(mesh, .25).empty());
    }
}

TEST_CASE("places for smaller triangles: small angles first, then low mean ratios",
          "[tetrahedra]") {
    using terrane::pipeline::detail::bad_places;
    const double y = std::sqrt(3.) / 2;
    TetrahedralMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {.5, y, 0}, {.5, y / 3, 9}};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    auto found = bad_places(mesh, 0);
    CHECK(found.bad == 0);
    CHECK(found.misshapen == 1);
    REQUIRE(found.sizes.size() == 1);
    CHECK(found.sizes[0].place.z == Approx(2.25)); // the height of the tetrahedron's centre
    mesh.vertices.insert(mesh.vertices.end(), {{20, 0, 0}, {22, 0, 0}, {21, 2, 0}, {21, .8, .01}});
    mesh.tetrahedra.push_back({4, 5, 6, 7});
    found = bad_places(mesh, 0);
    CHECK(found.apart == 1);
    CHECK(found.misshapen == 1);
    REQUIRE(found.sizes.size() == 1);
    CHECK(found.sizes[0].place.x == Approx(21));
}
