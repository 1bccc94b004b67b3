// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that vertices slide on the original surfaces, and that triangles too far from them are listed.
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/sliding_vertices.hpp>

using namespace terrane;

namespace {

/// A square of n x n cells with the height f(x, y).
template <class Height>
Mesh sheet(int n, const Height& f) {
    Mesh mesh;
    mesh.surfaces = {{"sheet", Role::horizon}};
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            mesh.vertices.push_back({double(i), double(j), f(double(i), double(j))});
    const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            for (const Triangle& t : {Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                      Triangle{at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
                mesh.triangles.push_back(t);
                mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
            }
    return mesh;
}

struct Improvement {
    ConformingMesh before;
    ImproveOptions options{};
    ImprovedAndMeasured improved;
};

Improvement improvement() {
    auto proof = prove_conforming(
        sheet(12, [](double x, double y) { return 0.02 * (x - 6) * (x - 6) + 0.01 * y * y; }));
    REQUIRE(proof);
    ImproveOptions options;
    options.edge_length = 2;
    auto improved = improve_and_measure(*proof, options);
    REQUIRE(improved);
    return {*proof, options, std::move(*improved)};
}

bool is_at_border(const Point3& p) {
    return p.x == 0 || p.x == 12 || p.y == 0 || p.y == 12;
}

} // namespace

TEST_CASE("sliding vertices: those inside of sheets go to the surface before", "[quality]") {
    const Improvement made = improvement();
    const Mesh& mesh = *made.improved.improved.mesh;
    const SlidingVertices sliding(*made.before, made.improved.improved, made.options, {});
    std::size_t inner = 0;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const Point3& p = mesh.vertices[v];
        CHECK(sliding.is_inner(v) != is_at_border(p));
        if (!sliding.is_inner(v)) continue;
        ++inner;
        const auto place = sliding.place(v, {p.x + 0.25, p.y - 0.125, p.z + 3});
        REQUIRE(place);
        CHECK(place->x == p.x + 0.25);
        CHECK(place->y == p.y - 0.125);
        // The surface before is within a hundredth of the paraboloid.
        CHECK(place->z ==
              Approx(0.02 * std::pow(place->x - 6, 2) + 0.01 * std::pow(place->y, 2)).margin(0.01));
        CHECK_FALSE(sliding.place(v, {20, 20, p.z})); // beyond the border
    }
    CHECK(inner > 10);
}

TEST_CASE("sliding vertices: triangles beyond the bound are told", "[quality]") {
    const Improvement made = improvement();
    const Mesh& mesh = *made.improved.improved.mesh;
    const SlidingVertices sliding(*made.before, made.improved.improved, made.options, {});
    const double bound = made.improved.improved.report.bound_of[0];
    CHECK(sliding.not_shown(mesh.vertices).empty());
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        if (!sliding.is_inner(v)) continue;
        auto points = mesh.vertices;
        points[v].z += 2.5 * bound;
        const auto open = sliding.not_shown(points);
        CHECK_FALSE(open.empty());
        for (const std::uint32_t t : open) {
            const Triangle& c = mesh.triangles[t];
            CHECK((c[0] == v || c[1] == v || c[2] == v));
        }
        points[v] = {mesh.vertices[v].x + 1e-3, mesh.vertices[v].y, mesh.vertices[v].z};
        points[v] = *sliding.place(v, points[v]);
        CHECK(sliding.not_shown(points).empty());
    }
}

TEST_CASE("with_vertices_at: a mesh is proven and measured again", "[quality]") {
    const Improvement made = improvement();
    const Improved& improved = made.improved.improved;
    const Mesh& mesh = *improved.mesh;
    std::uint32_t inner = 0;
    while (is_at_border(mesh.vertices[inner])) ++inner;
    auto points = mesh.vertices;
    points[inner].z += 0.25;
    const auto moved = with_vertices_at(made.before, made.improved, points);
    REQUIRE(moved);
    REQUIRE(*moved);
    const ImprovedAndMeasured& now = **moved;
    CHECK(now.improved.mesh->vertices == points);
    CHECK(now.improved.mesh->triangles == mesh.triangles);
    REQUIRE(now.improved.conforming);
    CHECK(&*now.improved.conforming->mesh() == &*now.improved.mesh);
    CHECK(now.deviations[0].out > 0.2);
    CHECK(now.deviations[0].out > made.improved.deviations[0].out);
    CHECK(now.improved.report.after.q.min <= improved.report.after.q.min);
    CHECK(now.improved.report.bound_of == improved.report.bound_of); // the caller's business

    // A vertex on another one, and one in the middle of an edge.
    points = mesh.vertices;
    points[inner] = points[inner == 0 ? 1 : 0];
    const auto doubled = with_vertices_at(made.before, made.improved, points);
    REQUIRE(doubled);
    CHECK_FALSE(*doubled);
    points = mesh.vertices;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] == inner || t[1] == inner || t[2] == inner) continue;
        const Point3 &a = points[t[0]], &b = points[t[1]];
        points[inner] = {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
        break;
    }
    const auto crossing = with_vertices_at(made.before, made.improved, points);
    REQUIRE(crossing);
    CHECK_FALSE(*crossing);
    points[inner].x = std::nan("");
    const auto not_a_number = with_vertices_at(made.before, made.improved, points);
    REQUIRE_FALSE(not_a_number);
    CHECK(not_a_number.error().code == ErrorCode::bad_number);
}
