// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that surfaces which share points stay together while they move.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <vector>

#include <terrane/algorithms/uncertainty/shared_places.hpp>

using namespace terrane;

namespace {

/// A grid of n x n squares from `origin`, along two directions.
Surface sheet_of(const char* name, Role role, unsigned n, const Point3& origin, const Point3& u,
                 const Point3& v) {
    Surface s{name, role, {}, {}};
    for (unsigned i = 0; i <= n; ++i)
        for (unsigned j = 0; j <= n; ++j)
            s.vertices.push_back({origin.x + i * u.x + j * v.x, origin.y + i * u.y + j * v.y,
                                  origin.z + i * u.z + j * v.z});
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) {
            const unsigned a = i * (n + 1) + j, b = a + n + 1;
            s.triangles.push_back({a, b, b + 1});
            s.triangles.push_back({a, b + 1, a + 1});
        }
    return s;
}

/// A horizon that ends at a dipping fault, on the fault's own vertices, and its continuation.
std::vector<Surface> horizon_at_fault() {
    return {sheet_of("left", Role::horizon, 8, {-8, 0, 0}, {1, 0, 0}, {0, 1, 0}),
            sheet_of("fault", Role::fault, 8, {-4, 0, -8}, {1, 0, 2}, {0, 1, 0}),
            sheet_of("far", Role::horizon, 4, {100, 0, 0}, {1, 0, 0}, {0, 1, 0})};
}

std::vector<std::vector<Point3>> still(const std::vector<Surface>& surfaces) {
    std::vector<std::vector<Point3>> own;
    for (const Surface& s : surfaces) own.emplace_back(s.vertices.size());
    return own;
}

Point3 moved(const Point3& p, const Point3& by) {
    return {p.x + by.x, p.y + by.y, p.z + by.z};
}

/// Requires that vertices at one place are at one place afterwards.
void check_together(const std::vector<Surface>& surfaces,
                    const std::vector<std::vector<Point3>>& motions) {
    std::map<Point3, Point3> to;
    for (std::size_t s = 0; s < surfaces.size(); ++s)
        for (std::size_t v = 0; v < surfaces[s].vertices.size(); ++v) {
            const Point3 p = surfaces[s].vertices[v], q = moved(p, motions[s][v]);
            const auto [at, is_new] = to.emplace(p, q);
            CHECK((is_new || at->second == q));
        }
}

} // namespace

TEST_CASE("shared places: what coincides stays together, and a horizon slides along its fault",
          "[uncertainty]") {
    const auto surfaces = horizon_at_fault();
    const SharedPlaces places(surfaces, {Motion::vertical, Motion::across, Motion::vertical});
    CHECK(places.shared_count() == 9);
    auto own = still(surfaces);
    for (Point3& by : own[0]) by = {0, 0, 0.75};
    const auto motions = places.reconciled(own);
    check_together(surfaces, motions);
    for (std::size_t v = 0; v < surfaces[1].vertices.size(); ++v) {
        // The fault keeps its plane, z = 2 x.
        const Point3 q = moved(surfaces[1].vertices[v], motions[1][v]);
        CHECK(q.z == Approx(2 * q.x).margin(1e-12));
    }
    for (std::size_t v = 0; v < 81; ++v) {
        CHECK(motions[0][v].z == Approx(0.75));
        if (v >= 72) CHECK(motions[0][v].x == Approx(0.375)); // along the fault
    }
    for (const Point3& by : motions[2]) CHECK(by == Point3{});
}

TEST_CASE("shared places: the fault's triangles do not fold between its cutoff and its tips",
          "[uncertainty]") {
    const auto surfaces = horizon_at_fault();
    const SharedPlaces places(surfaces, {Motion::vertical, Motion::across, Motion::vertical});
    auto own = still(surfaces);
    for (Point3& by : own[0]) by = {0, 0, 6}; // three rows of the fault
    const auto motions = places.reconciled(own);
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned j = 0; j <= 8; ++j) {
            const unsigned a = i * 9 + j, b = a + 9;
            CHECK(moved(surfaces[1].vertices[a], motions[1][a]).z <
                  moved(surfaces[1].vertices[b], motions[1][b]).z);
        }
}

TEST_CASE("shared places: a fault takes a horizon with it", "[uncertainty]") {
    const auto surfaces = horizon_at_fault();
    const SharedPlaces places(surfaces, {Motion::vertical, Motion::across, Motion::vertical});
    auto own = still(surfaces);
    for (Point3& by : own[1]) by = {2, 0, -1};
    const auto motions = places.reconciled(own);
    check_together(surfaces, motions);
    for (std::size_t v = 0; v < surfaces[1].vertices.size(); ++v)
        CHECK(motions[1][v] == Point3{2, 0, -1});
    for (unsigned i = 1; i < 8; ++i) // it fades from the fault to the far end
        CHECK(motions[0][i * 9 + 4].x < motions[0][(i + 1) * 9 + 4].x);
    CHECK(motions[0][4] == Point3{});
}

TEST_CASE("shared places: horizons that go on lead those that end", "[uncertainty]") {
    std::vector<Surface> surfaces{
        sheet_of("base", Role::horizon, 8, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
        sheet_of("onlap", Role::horizon, 8, {4, 0, 0}, {1, 0, 1}, {0, 1, 0})};
    const SharedPlaces places(surfaces, {Motion::vertical, Motion::vertical});
    auto own = still(surfaces);
    for (Point3& by : own[0]) by.z = 1;
    for (Point3& by : own[1]) by.z = -3;
    const auto motions = places.reconciled(own);
    check_together(surfaces, motions);
    // The base goes on through the line, except at its two ends, where both end and share the mean.
    for (unsigned j = 1; j < 8; ++j) CHECK(motions[1][j].z == 1);
    CHECK(motions[1][0].z == -1);
    // Parts of one name go on into each other: neither ends at their seam.
    surfaces = {sheet_of("top", Role::horizon, 4, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                sheet_of("top", Role::horizon, 4, {4, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                sheet_of("other", Role::horizon, 4, {4, 0, 0}, {0, 0, 1}, {0, 1, 0})};
    const SharedPlaces parts(surfaces, {Motion::vertical, Motion::vertical, Motion::vertical});
    own = still(surfaces);
    for (const std::size_t s : {0U, 1U})
        for (Point3& by : own[s]) by.z = 2;
    for (Point3& by : own[2]) by.z = 5;
    const auto seam = parts.reconciled(own);
    check_together(surfaces, seam);
    for (unsigned j = 1; j < 4; ++j) CHECK(seam[1][j].z == 2);
}

TEST_CASE("shared places: vertices at one place of one surface move alike", "[uncertainty]") {
    std::vector<Surface> surfaces{{"torn", Role::horizon, {}, {}}};
    surfaces[0].vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    surfaces[0].triangles = {{0, 1, 2}, {3, 5, 4}};
    const SharedPlaces places(surfaces, {Motion::vertical});
    CHECK(places.shared_count() == 0);
    auto own = still(surfaces);
    for (std::size_t v = 0; v < 6; ++v) own[0][v].z = static_cast<double>(v);
    const auto motions = places.reconciled(own);
    check_together(surfaces, motions);
    CHECK(motions[0][1].z == 2); // the mean of 1 and 3
}
