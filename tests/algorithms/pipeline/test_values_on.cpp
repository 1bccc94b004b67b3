// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that values of surfaces come along through all stages.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "support/work_count.hpp"
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/values.hpp>
#include <terrane/algorithms/pipeline/build.hpp>

namespace values_on_test {

using namespace terrane;
using namespace test_support;

namespace {

double linear(const Point3& p) {
    return 3 * p.x - 2 * p.y + 0.5 * p.z + 7;
}

/// Gives a surface a linear function, a vector, a step function of integers, and numbers of triangles.
void add_values(Surface& s, std::int64_t number) {
    std::vector<double> heights, vectors;
    std::vector<std::int64_t> steps, of_triangles(s.triangles.size(), number);
    for (const Point3& p : s.vertices) {
        heights.push_back(linear(p));
        vectors.insert(vectors.end(), {p.x, -linear(p), 1});
        steps.push_back(p.z > 2 ? 20 : 10);
    }
    s.arrays = {{.name = "height", .numbers = heights, .unit = "m"},
                {.name = "vector", .components = 3, .numbers = vectors},
                {.name = "step", .type = NumberType::uint8, .numbers = steps},
                {.name = "number",
                 .on_triangles = true,
                 .type = NumberType::int32,
                 .numbers = of_triangles}};
}

const std::vector<double>& reals(const ValueArray& array) {
    return std::get<std::vector<double>>(array.numbers);
}
const std::vector<std::int64_t>& integers(const ValueArray& array) {
    return std::get<std::vector<std::int64_t>>(array.numbers);
}

/// Checks the values of add_values() on a mesh. Returns how many vertices of surfaces there are.
std::size_t check_values(const std::vector<SurfaceValues>& values, const Mesh& mesh,
                         const std::vector<std::int64_t>& numbers) {
    const auto surfaces = surfaces_of_mesh(mesh);
    std::size_t count = 0;
    for (std::size_t s = 0; s < numbers.size(); ++s) {
        CAPTURE(s);
        const Surface& surface = surfaces[s];
        if (numbers[s] < 0) {
            CHECK(values[s].empty());
            continue;
        }
        REQUIRE(values[s].size() == 4);
        CHECK(values[s][0].unit == "m");
        REQUIRE(values[s][0].size() == surface.vertices.size());
        REQUIRE(values[s][1].size() == surface.vertices.size());
        double worst = 0;
        for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
            const Point3& p = surface.vertices[v];
            worst = std::max({worst, std::fabs(reals(values[s][0])[v] - linear(p)),
                              std::fabs(reals(values[s][1])[3 * v] - p.x),
                              std::fabs(reals(values[s][1])[3 * v + 1] + linear(p)),
                              std::fabs(reals(values[s][1])[3 * v + 2] - 1)});
        }
        CHECK(worst < 1e-13 * 64);
        const auto& steps = integers(values[s][2]);
        CHECK(std::ranges::all_of(steps, [](std::int64_t n) { return n == 10 || n == 20; }));
        const auto& of_triangles = integers(values[s][3]);
        REQUIRE(of_triangles.size() == surface.triangles.size());
        CHECK(std::ranges::count(of_triangles, numbers[s]) ==
              static_cast<std::ptrdiff_t>(of_triangles.size()));
        count += surface.vertices.size();
    }
    return count;
}

/// The model of work_count.hpp with values on all surfaces but the second.
std::vector<Surface> model_with_values() {
    auto surfaces = sectors();
    for (const std::size_t s : {0, 2, 3}) add_values(surfaces[s], static_cast<std::int64_t>(s));
    return surfaces;
}

} // namespace

TEST_CASE("values: a linear function is exact at all vertices after each stage", "[values]") {
    Project project;
    project.improve = ProjectImprove{.options = {.edge_length = 2}};
#ifdef TERRANE_HAS_TETGEN
    project.outputs.tetrahedra = {"vtu"};
#endif
    const auto built = build(project, {.surfaces = model_with_values()});
    if (!built) FAIL(built.error().message());
    const std::vector<std::int64_t> numbers{0, -1, 2, 3};
    const Mesh &rounded = *built->arranged.rounded.mesh,
               &improved = *built->improved->improved.mesh;
    const auto arranged = check_values(values_on(*built, rounded), rounded, numbers);
    const auto better = check_values(values_on(*built, improved), improved, numbers);
    CHECK(better > arranged);
#ifdef TERRANE_HAS_TETGEN
    const auto check_faces = [&](const Built& made) {
        const TetrahedralMesh& t = made.filled->tetrahedra;
        Mesh faces;
        faces.surfaces = t.surfaces;
        faces.vertices = t.vertices;
        faces.triangles = t.faces;
        faces.surfaces_of = t.surfaces_of;
        CHECK(check_values(values_on(made, t), faces, numbers) > 0);
    };
    check_faces(*built);
    project.improve = {};
    project.tetrahedra.options.edge_length = 1;
    const auto as_given = build(project, {.surfaces = model_with_values()});
    if (!as_given) FAIL(as_given.error().message());
    check_faces(*as_given);
#endif
}

TEST_CASE("values: they do not change the model, nor does their lack cost memory", "[values]") {
    Project project;
    project.last = BuildStage::arrange;
    const auto with = build(project, {.surfaces = model_with_values()});
    const auto without = build(project, {.surfaces = sectors()});
    REQUIRE(with);
    REQUIRE(without);
    CHECK(with->arranged.rounded.mesh->vertices == without->arranged.rounded.mesh->vertices);
    CHECK(with->arranged.rounded.mesh->triangles == without->arranged.rounded.mesh->triangles);
    CHECK(without->given.empty());
    CHECK(values_on(*without, *without->arranged.rounded.mesh).empty());
}

TEST_CASE("values: where surfaces are cut and sealed, given triangles keep their values",
          "[values]") {
    // A wall that ends 0.1 before the floor, in a volume of interest.
    Surface floor{"floor",
                  Role::horizon,
                  {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}},
                  {{0, 1, 2}, {0, 2, 3}}},
        wall{"wall",
             Role::fault,
             {{0, -9, 0.1}, {0, 9, 0.1}, {0, 9, 7}, {0, -9, 7}},
             {{0, 1, 2}, {0, 2, 3}}};
    add_values(floor, 0);
    add_values(wall, 1);
    Surface around = sectors()[0];
    for (Point3& p : around.vertices) p = {p.x - 4, p.y - 4, p.z - 4};
    Project project;
    project.last = BuildStage::arrange;
    project.seal = 0.3;
    const auto built = build(project, {.surfaces = {floor, wall}, .boundary = {around}});
    REQUIRE(built);
    REQUIRE(built->arranged.sealed);
    REQUIRE_FALSE(built->arranged.sealed->changes.empty());
    const Mesh& mesh = *built->arranged.rounded.mesh;
    const auto values = values_on(*built, mesh);
    const auto surfaces = surfaces_of_mesh(mesh);
    for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t v = 0; v < surfaces[s].vertices.size(); ++v) {
            // The extension has the value of the nearest point of the wall.
            Point3 p = surfaces[s].vertices[v];
            if (s == 1) p.z = std::max(p.z, 0.1);
            CHECK(reals(values[s][0])[v] == Approx(linear(p)).epsilon(1e-12));
        }
    CHECK(std::ranges::count(integers(values[1][3]), 1) ==
          static_cast<std::ptrdiff_t>(surfaces[1].triangles.size()));
    CHECK(values[2].empty());
}

TEST_CASE("values: vertices that are there still keep their bits, and NaN and no data stay",
          "[values]") {
    Surface a{
        "a", Role::horizon, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}}, {{0, 1, 2}, {1, 3, 2}}},
        b{"b", Role::fault, {{1, 1, -1}, {1, 1, 1}, {1, 9, 0}}, {{0, 1, 2}}};
    a.arrays = {
        {.name = "v", .numbers = std::vector<double>{0.1, -9, std::nan(""), 1e300}, .no_data = -9}};
    Project project;
    project.last = BuildStage::arrange;
    const auto built = build(project, {.surfaces = {a, b}});
    REQUIRE(built);
    const Mesh& mesh = *built->arranged.rounded.mesh;
    const auto values = values_on(*built, mesh);
    const auto surfaces = surfaces_of_mesh(mesh);
    const auto& v = reals(values[0][0]);
    CHECK(values[0][0].no_data == -9);
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Point3& p = surfaces[0].vertices[i];
        if (p == Point3{0, 0, 0})
            CHECK(v[i] == 0.1);
        else if (p == Point3{4, 4, 0})
            CHECK(v[i] == 1e300);
        else if (p == Point3{0, 4, 0})
            CHECK(std::isnan(v[i]));
        else
            CHECK(v[i] == -9); // a corner that counts has no value
    }
}

TEST_CASE("values: a corner without a value does not count on the edge that is opposite",
          "[values]") {
    Surface a{"a", Role::horizon, {{0.1, 0.3, 0.7}, {4.1, 0.7, 0.9}, {0.3, 4.9, 0.2}}, {{0, 1, 2}}},
        b{"b", Role::fault, {{1.3, -9, -9}, {1.7, -9, 9}, {1.1, 9, 0}}, {{0, 1, 2}}};
    a.arrays = {{.name = "v", .numbers = std::vector<double>{1, 2, std::nan("")}}};
    Project project;
    project.last = BuildStage::arrange;
    const auto built = build(project, {.surfaces = {a, b}});
    REQUIRE(built);
    const auto values = values_on(*built, *built->arranged.rounded.mesh);
    const auto& v = reals(values[0][0]);
    CHECK(std::ranges::count_if(v, [](double n) { return n > 1 && n < 2; }) == 1);
    CHECK(std::ranges::count_if(v, [](double n) { return std::isnan(n); }) == 2);
}

TEST_CASE("values: surfaces that were joined have the values of the nearest point", "[values]") {
    const auto square = [](const std::string& name, double z, std::uint32_t n) {
        Surface s{name, Role::horizon, {}, {}};
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t i = 0; i <= n; ++i)
                s.vertices.push_back({8.0 * i / n, 8.0 * j / n, z + 0.01 * ((i + j) % 2)});
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t v = (n + 1) * j + i;
                s.triangles.push_back({v, v + 1, v + n + 2});
                s.triangles.push_back({v, v + n + 2, v + n + 1});
            }
        add_values(s, 4);
        return s;
    };
    Project project;
    project.last = BuildStage::arrange;
    project.tolerance = 0.1;
    const auto built = build(project, {.surfaces = {square("a", 4, 5), square("b", 4.02, 7)}});
    REQUIRE(built);
    REQUIRE(built->arranged.joined->is_joined);
    const Mesh& mesh = *built->arranged.rounded.mesh;
    const auto values = values_on(*built, mesh);
    const auto surfaces = surfaces_of_mesh(mesh);
    std::size_t count = 0;
    for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t v = 0; v < surfaces[s].vertices.size(); ++v, ++count)
            CHECK(std::fabs(reals(values[s][0])[v] - linear(surfaces[s].vertices[v])) < 0.1 * 4);
    CHECK(count > 0);
}

TEST_CASE("values: where triangles of a surface overlap, the first parent has the values",
          "[values]") {
    Surface s{"s",
              Role::horizon,
              {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
              {{3, 4, 5}, {0, 1, 2}}};
    s.arrays = {{.name = "t",
                 .on_triangles = true,
                 .type = NumberType::int8,
                 .numbers = std::vector<std::int64_t>{7, 8}}};
    Project project;
    project.last = BuildStage::arrange;
    const auto built = build(project, {.surfaces = {s}});
    REQUIRE(built);
    CHECK(integers(values_on(*built, *built->arranged.rounded.mesh)[0][0]) ==
          std::vector<std::int64_t>{7});
}

TEST_CASE("values: a filling has none", "[values]") {
    // A square of 8 x 8 without its middle.
    Surface s{"s", Role::horizon, {}, {}};
    for (int j = 0; j <= 8; ++j)
        for (int i = 0; i <= 8; ++i) s.vertices.push_back({double(i), double(j), 0.25 * i});
    for (std::uint32_t j = 0; j < 8; ++j)
        for (std::uint32_t i = 0; i < 8; ++i) {
            if (i >= 3 && i < 5 && j >= 3 && j < 5) continue;
            const std::uint32_t v = 9 * j + i;
            s.triangles.push_back({v, v + 1, v + 10});
            s.triangles.push_back({v, v + 10, v + 9});
        }
    add_values(s, 5);
    for (const BuildStage last : {BuildStage::preprocess, BuildStage::arrange}) {
        Project project;
        project.last = last;
        project.fill = {ProjectFill{.surface = "s"}};
        const auto built = build(project, {.surfaces = {s}});
        REQUIRE(built);
        const Surface& filled = built->preprocessed.filled->surfaces.at(0).filled;
        REQUIRE(filled.triangles.size() > s.triangles.size());
        const Mesh mesh = last == BuildStage::arrange ? *built->arranged.rounded.mesh
                                                      : concatenate(std::vector{filled});
        const auto values =
            last == BuildStage::arrange ? values_on(*built, mesh) : values_on_preprocessed(*built);
        const auto surface = surface_of_mesh(mesh, 0);
        REQUIRE(values.size() == 1);
        std::size_t none = 0;
        for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
            const Point3& p = surface.vertices[v];
            const bool inside = p.x > 3 && p.x < 5 && p.y > 3 && p.y < 5;
            CHECK(has_no_data(values[0][0], v) == inside);
            if (!inside) CHECK(reals(values[0][0])[v] == Approx(linear(p)));
        }
        for (std::size_t t = 0; t < surface.triangles.size(); ++t)
            if (has_no_data(values[0][3], t)) ++none;
        CHECK(none == filled.triangles.size() - s.triangles.size());
    }
}

} // namespace values_on_test
