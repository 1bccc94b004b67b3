// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <limits>
#include <vector>

#include <terrane/algorithms/mesh/validation.hpp>

using namespace terrane;

namespace {

Mesh two_triangles() {
    Mesh mesh;
    mesh.surfaces = {{"top", Role::horizon}};
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    for (int t = 0; t < 2; ++t) mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    return mesh;
}

void check_refused(const Status& status, ErrorCode code, const std::string& place) {
    REQUIRE_FALSE(status.ok());
    CHECK(status.error().code == code);
    CHECK(status.error().place == place);
}

} // namespace

TEST_CASE("validation: a sound mesh passes, with one thread or with several") {
    const Mesh mesh = two_triangles();
    for (const unsigned threads : {1U, 2U}) {
        Run run;
        run.threads = threads;
        CHECK(validate(mesh.vertices, mesh.triangles, run).ok());
        CHECK(validate_areas(mesh.vertices, mesh.triangles, run).ok());
        CHECK(validate_mesh(mesh, run).ok());
    }
    CHECK(validate_mesh(Mesh{}).ok());
}

TEST_CASE("validation: the first flaw is named, whatever the number of threads") {
    Mesh mesh;
    mesh.vertices.assign(40000, Point3{0, 0, 0});
    for (std::uint32_t v = 0; v < 40000; ++v) mesh.vertices[v] = {v * 1.0, v * 1.0 * v, 0};
    for (std::uint32_t v = 0; v + 2 < 40000; ++v) mesh.triangles.push_back({v, v + 1, v + 2});
    mesh.triangles[30000] = {5, 6, 5};
    mesh.triangles[20000] = {7, 8, 7};
    Run run;
    run.threads = 2;
    CHECK(validate(mesh.vertices, mesh.triangles, run).ok()); // areas are not required
    check_refused(validate_areas(mesh.vertices, mesh.triangles, run), ErrorCode::improper_contact,
                  "triangle 20000");
    mesh.triangles[25000][1] = 40000;
    check_refused(validate_areas(mesh.vertices, mesh.triangles, run), ErrorCode::bad_index,
                  "triangle 25000");
    mesh.vertices[33333].z = std::numeric_limits<double>::infinity();
    mesh.vertices[39999].x = std::numeric_limits<double>::quiet_NaN();
    check_refused(validate(mesh.vertices, mesh.triangles, run), ErrorCode::bad_number,
                  "vertex 33333");
}

TEST_CASE("validation: the place names the surface") {
    Surface sound{"top", Role::unknown, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    Surface broken = sound;
    broken.name = "base";
    broken.triangles.push_back({0, 1, 3});
    CHECK(validate(std::vector{sound}).ok());
    check_refused(validate(std::vector{sound, broken}), ErrorCode::bad_index,
                  "surface base, triangle 1");
    broken.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
    check_refused(validate(std::vector{sound, broken}), ErrorCode::bad_number,
                  "surface base, vertex 2");
}

TEST_CASE("validation: lists of a mesh") {
    Mesh mesh = two_triangles();
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    check_refused(validate_mesh(mesh), ErrorCode::bad_index, "");
    mesh = two_triangles();
    mesh.surfaces_of.values[1] = 1;
    check_refused(validate_mesh(mesh), ErrorCode::bad_index, "triangle 1");
    mesh = two_triangles();
    mesh.surfaces_of = {};
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    mesh.surfaces_of.close();
    check_refused(validate_mesh(mesh), ErrorCode::bad_index, "triangle 1");
    mesh = two_triangles();
    mesh.regions_of.push_back(std::vector<std::uint32_t>{0});
    check_refused(validate_mesh(mesh), ErrorCode::bad_index, "");
}

TEST_CASE("validation: each list of a mesh can be walked through, and names what is there") {
    const Mesh sound = [] {
        Mesh mesh = two_triangles();
        mesh.regions_of = mesh.surfaces_of;
        mesh.parents_of = mesh.surfaces_of;
        mesh.intersection_edges = {{1, 2}};
        return mesh;
    }();
    REQUIRE(validate_indices(sound).ok());
    REQUIRE(validate_indices(Mesh{}).ok());
    const std::vector<void (*)(Mesh&)> flaws{
        [](Mesh& m) {
            m.surfaces_of.offsets = {0, 2, 1};
        },
        [](Mesh& m) {
            m.surfaces_of.offsets = {0, 1, 1};
        },
        [](Mesh& m) {
            m.surfaces_of.offsets = {1, 1, 2};
        },
        [](Mesh& m) { m.surfaces_of.offsets.clear(); },
        [](Mesh& m) { m.surfaces_of.values.pop_back(); },
        [](Mesh& m) {
            m.regions_of.offsets = {0, 0, 2};
        },
        [](Mesh& m) { m.regions_of.values[1] = 2; }, // two triangles have two regions at most
        [](Mesh& m) { m.regions_of = {}, m.regions_of.values = {0}; },
        [](Mesh& m) { m.parents_of.offsets.pop_back(); },
        [](Mesh& m) { m.parents_of.values[0] = UINT32_MAX; },
        [](Mesh& m) {
            m.intersection_edges[0] = {2, 1};
        },
        [](Mesh& m) {
            m.intersection_edges[0] = {1, 4};
        },
        [](Mesh& m) { m.triangles[1][2] = 4; },
        [](Mesh& m) { m.triangles.pop_back(); },
    };
    for (std::size_t i = 0; i < flaws.size(); ++i) {
        Mesh mesh = sound;
        flaws[i](mesh);
        const Status status = validate_indices(mesh);
        CAPTURE(i);
        REQUIRE_FALSE(status.ok());
        CHECK(status.error().code == ErrorCode::bad_index);
    }
}

TEST_CASE("validation: each list of tetrahedra has its length, and names what is there") {
    TetrahedralMesh sound;
    sound.surfaces = {{"top", Role::horizon}};
    sound.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    sound.tetrahedra = {{0, 1, 2, 3}};
    sound.block_of = {1};
    sound.faces = {{0, 1, 2}, {0, 1, 3}};
    sound.face_triangle = {0, UINT32_MAX};
    for (int f = 0; f < 2; ++f) sound.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    sound.twins = {{0, 1}};
    sound.block_count = 2;
    REQUIRE(validate_indices(sound).ok());
    const std::vector<void (*)(TetrahedralMesh&)> flaws{
        [](TetrahedralMesh& m) { m.tetrahedra[0][3] = 4; },
        [](TetrahedralMesh& m) { m.block_of.clear(); },
        [](TetrahedralMesh& m) { m.block_of[0] = 2; },
        [](TetrahedralMesh& m) { m.faces[1][0] = 4; },
        [](TetrahedralMesh& m) { m.face_triangle.pop_back(); },
        [](TetrahedralMesh& m) { m.surfaces_of.values[1] = 1; },
        [](TetrahedralMesh& m) {
            m.surfaces_of.offsets = {0, 2, 2};
        },
        [](TetrahedralMesh& m) { m.twins[0][1] = 2; },
        [](TetrahedralMesh& m) { m.surfaces.clear(); },
    };
    for (std::size_t i = 0; i < flaws.size(); ++i) {
        TetrahedralMesh mesh = sound;
        flaws[i](mesh);
        CAPTURE(i);
        REQUIRE_FALSE(validate_indices(mesh).ok());
    }
    sound.vertices[0].x = std::numeric_limits<double>::quiet_NaN();
    check_refused(validate_indices(sound), ErrorCode::bad_number, "vertex 0");
}
