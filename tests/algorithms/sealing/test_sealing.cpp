// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks what closing known gaps changes and what it must not change.
#include <terrane/algorithms/sealing/sealing.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Checks that strips end on other surfaces, or free at a side that is no longer than their width.
void check_strip_ends(const std::vector<Surface>& surfaces, const Sealed& s, double distance) {
    const Arrangement& a = s.arrangement;
    for (std::size_t e = 0; e < a.state->adjacency.edges.size(); ++e) {
        const auto at = a.state->adjacency.triangles_at[e];
        if (at.size() != 1) continue;
        const InputTriangleId parent(a.parents_of[at[0]][0]);
        const SurfaceId surface = a.inputs.surface_of(parent);
        if (parent - a.inputs.first[surface] < surfaces[surface].triangles.size()) continue;
        const auto [v, w] = a.state->adjacency.edges[e];
        const Point3 p = a.state->points.nearest(a.vertices[v]),
                     q = a.state->points.nearest(a.vertices[w]);
        CHECK(std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) < 12 * distance);
    }
}

Sealed sealed(const std::vector<Surface>& surfaces, double distance) {
    auto made = seal(surfaces, {.distance = distance});
    INFO((made ? std::string() : made.error().message()));
    REQUIRE(made);
    check_strip_ends(surfaces, made.value(), distance);
    return std::move(made).value();
}
Volumes volumes_of(const Arrangement& a) {
    const auto volumes = find_volumes(a);
    REQUIRE(volumes);
    return volumes.value();
}

/// Checks that the arrangement is conforming in doubles, too.
void check_rounds(const Arrangement& a) {
    const auto rounded = round_to_doubles(a);
    REQUIRE(rounded);
    CHECK(rounded.value().report.clean);
}

/// Builds a horizon over [x0, x1] x [y0, y1] of n by n cells at heights z(x, y).
template <class Height>
Surface horizon_grid(double x0, double y0, double x1, double y1, unsigned n, const Height& z,
                     std::string name) {
    const auto node = [&](unsigned i, unsigned j) {
        const double x = x0 + (x1 - x0) * i / n, y = y0 + (y1 - y0) * j / n;
        return Point3{x, y, z(x, y)};
    };
    return grid(n, n, node, std::move(name), Role::horizon);
}

Surface moved_by(Surface s, const Point3& by) {
    for (Point3& p : s.vertices) p = {p.x + by.x, p.y + by.y, p.z + by.z};
    return s;
}

std::size_t kinds(const Sealed& s, SealKind kind) {
    return static_cast<std::size_t>(std::count_if(s.changes.begin(), s.changes.end(),
                                                  [&](const auto& c) { return c.kind == kind; }));
}

} // namespace

TEST_CASE("sealing: a horizon that stops short of the walls of a box is extended to them",
          "[seal]") {
    for (const unsigned n : {1U, 4U}) {
        const auto flat = [](double, double) { return 4.0; };
        const std::vector<Surface> model{cube(0, 8),
                                         horizon_grid(0.1, 0.1, 7.95, 7.9, n, flat, "horizon")};
        CHECK(volumes_of(arrange(model).value()).block_count() == 1);
        const Sealed s = sealed(model, 0.11);
        const Volumes v = volumes_of(s.arrangement);
        CHECK(v.measures ==
              std::vector<double>{HUGE_VAL, 256, 256}); // the plane is continued exactly
        check_rounds(s.arrangement);
        REQUIRE(s.changes.size() == 1);
        CHECK(s.changes[0].kind == SealKind::extended);
        CHECK(s.changes[0].surface == 1);
        CHECK(s.changes[0].largest == Approx(0.1));
        CHECK(s.changes[0].length == Approx(2 * (7.85 + 7.8)));
        CHECK(s.changes[0].triangles > 0);
        CHECK(s.left == 0);
        for (std::size_t t = 0; t < s.arrangement.triangles.size(); ++t)
            CHECK(s.arrangement.surfaces_of[t].size() == 1);
    }
}

TEST_CASE("sealing: nothing changes if no gap is small enough", "[seal]") {
    const auto flat = [](double, double) { return 4.0; };
    const std::vector<Surface> model{cube(0, 8),
                                     horizon_grid(0.1, 0.1, 7.9, 7.9, 3, flat, "horizon"),
                                     level(2, 1, 1, 20, 7, "beyond")};
    const Arrangement a = arrange(model).value();
    const Sealed s = sealed(model, 0.0999);
    CHECK(s.changes.empty());
    CHECK(s.arrangement.state->whole);
    CHECK(s.arrangement.triangles == a.triangles);
    CHECK(s.arrangement.vertices == a.vertices);
    CHECK(s.arrangement.parents_of == a.parents_of);
    CHECK(s.arrangement.intersection_edges == a.intersection_edges);
    for (std::size_t i = 0; i < model.size(); ++i) {
        CHECK(s.surfaces[i].vertices == model[i].vertices);
        CHECK(s.surfaces[i].triangles == model[i].triangles);
    }
    CHECK(seal(model, {.distance = 0}).error().code == ErrorCode::bad_option);
    CHECK(seal(model, {.distance = NAN}).error().code == ErrorCode::bad_option);
}

TEST_CASE("sealing: a gap to a fault is closed at any angle", "[seal]") {
    // An inclined fault cuts the horizon, which stops 0.1 short of it on one side.
    for (const double lean : {0.0, 0.5, 1.0, 2.0, -1.0, -2.0}) {
        const Surface fault =
            quad({4 - 4.5 * lean, -1, -0.5}, {4 - 4.5 * lean, 9, -0.5}, {4 + 4.5 * lean, 9, 8.5},
                 {4 + 4.5 * lean, -1, 8.5}, "fault"); // at x = 4 at height 4
        const auto flat = [](double, double) { return 4.0; };
        const std::vector<Surface> model{cube(0, 8), fault,
                                         horizon_grid(-1, -1, 3.9, 9, 5, flat, "left")};
        INFO("lean " << lean);
        const Volumes before = volumes_of(arrange(model).value());
        const Sealed s = sealed(model, 0.1);
        const Volumes after = volumes_of(s.arrangement);
        CHECK(after.block_count() == before.block_count() + 1);
        CHECK(after.total == 512);
        check_rounds(s.arrangement);
        const double gap = 0.1 / std::hypot(1, lean);
        for (const SealChange& c : s.changes) {
            CHECK(c.surface == 2);
            CHECK(c.largest == Approx(gap));
        }
        const Sealed below = sealed(model, gap * 0.99);
        CHECK(below.changes.empty());
        const Sealed above = sealed(model, gap * 1.01);
        CHECK(volumes_of(above.arrangement).measures == after.measures);
    }
}

TEST_CASE("sealing: only the part of a border near the fault is closed", "[seal]") {
    // The border is near the fault for y < 4 and far from it for y > 4.
    Surface horizon = horizon_grid(
        0, 0, 3.9, 8, 8, [](double, double) { return 4.0; }, "horizon");
    for (Point3& p : horizon.vertices) p.x *= p.y > 4 ? 0.5 : 1;
    const std::vector<Surface> model{horizon,
                                     quad({4, 0, 0}, {4, 8, 0}, {4, 8, 8}, {4, 0, 8}, "fault")};
    const Sealed s = sealed(model, 0.15);
    REQUIRE(s.changes.size() == 1);
    CHECK(s.changes[0].length == Approx(4));
    CHECK(s.changes[0].largest == Approx(0.1));
    check_rounds(s.arrangement);
    // Four of the eight edges are closed; each is an edge of three triangles now.
    std::size_t on_fault = 0;
    for (const Edge& e : s.arrangement.intersection_edges) {
        const Point3 p = s.arrangement.state->points.nearest(s.arrangement.vertices[e[0]]),
                     q = s.arrangement.state->points.nearest(s.arrangement.vertices[e[1]]);
        CHECK(p.x == 4);
        CHECK(q.x == 4);
        on_fault += 1;
    }
    CHECK(on_fault >= 4);
}

TEST_CASE("sealing: ends that extend beyond a fault are trimmed", "[seal]") {
    const auto flat = [](double, double) { return 4.0; };
    const Surface box = cube(0, 8);
    const std::vector<Surface> model{box, horizon_grid(-0.1, -0.05, 8.1, 8.08, 3, flat, "horizon")};
    const Sealed s = sealed(model, 0.15);
    CHECK(volumes_of(s.arrangement).measures == std::vector<double>{HUGE_VAL, 256, 256});
    REQUIRE(s.changes.size() == 1);
    CHECK(s.changes[0].kind == SealKind::trimmed);
    CHECK(s.changes[0].largest == Approx(std::hypot(0.1, 0.08)));
    for (const PointIndex v : s.arrangement.vertices) {
        const Point3 p = s.arrangement.state->points.nearest(v);
        CHECK((p.x >= 0 && p.x <= 8 && p.y >= 0 && p.y <= 8));
    }
    check_rounds(s.arrangement);
    const Sealed none = sealed(model, 0.09); // less than at its corner
    CHECK(none.changes.empty());
    CHECK(none.arrangement.state->whole);
}

TEST_CASE("sealing: a border that crosses the fault back and forth is closed", "[seal]") {
    Random random(4);
    for (int round = 0; round < cases(12); ++round) {
        Surface horizon = horizon_grid(
            0, -1, 4, 9, 12, [](double, double) { return 4.0; }, "horizon");
        for (Point3& p : horizon.vertices)
            if (p.x == 4) p.x += random_real(random, -0.05, 0.05);
        const std::vector<Surface> model{
            cube(0, 8), quad({4, -1, -1}, {4, 9, -1}, {4, 9, 9}, {4, -1, 9}, "fault"), horizon,
            horizon_grid(
                -1, -1, 4, 9, 1, [](double, double) { return 2.0; }, "low")};
        const Sealed s = sealed(model, 0.06);
        const Volumes v = volumes_of(s.arrangement);
        CHECK(v.block_count() == 4); // three on the left, one on the right
        CHECK(v.total == 512);
        auto sorted = v.measures;
        std::sort(sorted.begin(), sorted.end());
        CHECK(sorted[0] == Approx(64));
        CHECK(sorted[1] == Approx(64));
        CHECK(sorted[2] == Approx(128));
        check_rounds(s.arrangement);
        CHECK(kinds(s, SealKind::extended) > 0);
        CHECK(kinds(s, SealKind::trimmed) > 0);
    }
}

TEST_CASE("sealing: a gap at the corner of two faults is closed", "[seal]") {
    // A horizon ends short of two walls that meet in a vertical edge, at any angle.
    for (const double turn : {0.0, 0.6, -0.6}) {
        const Surface first = quad({6, -1, -1}, {6, 6, -1}, {6, 6, 9}, {6, -1, 9}, "first"),
                      second = quad({6, 6, -1}, {-1, 6 + 7 * turn, -1}, {-1, 6 + 7 * turn, 9},
                                    {6, 6, 9}, "second");
        Surface horizon = horizon_grid(
            -1, -1, 5.9, 5.9, 6, [](double, double) { return 4.0; }, "horizon");
        for (Point3& p : horizon.vertices) // up to 0.1 before the second wall
            p.y = -1 + (p.y + 1) / 6.9 * (6.9 + turn * (6 - p.x));
        const std::vector<Surface> model{cube(0, 8), first, second, horizon};
        INFO("turn " << turn);
        const std::size_t before = volumes_of(arrange(model).value()).block_count();
        const Sealed s = sealed(model, 0.15);
        CHECK(volumes_of(s.arrangement).block_count() == before + 1);
        check_rounds(s.arrangement);
        // The second wall ends where the border of the horizon does, outside the box; the part of
        // the edge between them may remain.
        CHECK(s.left < 1.2);
    }
}

TEST_CASE("sealing: gaps of micrometres are closed on curved, rough surfaces at large coordinates",
          "[seal]") {
    Random random(9);
    for (const double gap : {2e-6, 1e-3, 0.1}) {
        const Point3 origin{3.7e5, 3.77e6, -1e4};
        Surface fault = horizon_grid(
            -200, -200, 1200, 1200, 9, [](double, double) { return 0.0; }, "fault");
        for (Point3& p : fault.vertices)
            p = {600 + 40 * std::sin(p.x / 150) + random_real(random, -5, 5), p.y, p.x - 500};
        Surface horizon = horizon_grid(
            -200, -200, 600, 1200, 16,
            [](double x, double y) { return 10 * std::sin(x / 90) + 8 * std::cos(y / 70); },
            "horizon");
        // The right border ends short of the fault by the gap, or beyond it.
        const Surface walls = box({0, 0, -300}, {1000, 1000, 300}, "walls");
        for (Point3& p : horizon.vertices) {
            if (p.x != 600) continue;
            double low = 400, high = 800; // the fault's x at this y and z, by bisection
            const auto side = [&](double x) {
                for (const Triangle& t : fault.triangles) {
                    const Point3 &a = fault.vertices[t[0]], &b = fault.vertices[t[1]],
                                 &c = fault.vertices[t[2]];
                    const double d = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
                    const double u = ((p.y - a.y) * (c.z - a.z) - (p.z - a.z) * (c.y - a.y)) / d,
                                 v = ((b.y - a.y) * (p.z - a.z) - (b.z - a.z) * (p.y - a.y)) / d;
                    if (u < 0 || v < 0 || u + v > 1) continue;
                    return x < a.x + u * (b.x - a.x) + v * (c.x - a.x);
                }
                return false;
            };
            for (int i = 0; i < 60; ++i) (side((low + high) / 2) ? low : high) = (low + high) / 2;
            p.x = low - random_real(random, -gap, gap) * 0.7;
        }
        std::vector<Surface> model{walls, fault, horizon};
        for (Surface& s : model) s = moved_by(s, origin);
        // A straight edge between points on a rough surface leaves it by far more than the gap.
        const double distance = 6;
        const std::size_t before = volumes_of(arrange(model).value()).block_count();
        const Sealed s = sealed(model, distance);
        INFO("gap " << gap << ", left " << s.left);
        CHECK(volumes_of(s.arrangement).block_count() >= before + 1);
        check_rounds(s.arrangement);
        for (const SealChange& c : s.changes) CHECK(c.largest <= distance);
    }
}

TEST_CASE("sealing: free borders far from other surfaces do not change", "[seal]") {
    const std::vector<Surface> model{cube(0, 8), level(4, 2, 2, 6, 6, "inside"),
                                     quad({-3, 4, 4}, {3, 4, 4}, {3, 4, 6}, {-3, 4, 6}, "through")};
    const Sealed s = sealed(model, 0.5);
    CHECK(s.changes.empty());
    CHECK(s.arrangement.triangles == arrange(model).value().triangles);
}

TEST_CASE("sealing: the result does not depend on threads, also within a volume of interest",
          "[seal]") {
    const auto flat = [](double x, double y) { return 4 + 0.1 * x - 0.05 * y; };
    std::vector<Surface> model{horizon_grid(0.1, 0.1, 3.92, 8.5, 4, flat, "left"),
                               horizon_grid(4.03, -1, 9, 9, 3, flat, "right"),
                               quad({4, -1, -1}, {4, 9, -1}, {4, 9, 9}, {4, -1, 9}, "fault")};
    auto boundary = box_boundary({0, 0, 0}, {8, 8, 8}).value();
    model.insert(model.end(), boundary.begin(), boundary.end());
    Run one, four;
    four.threads = 4;
    const auto a = seal(model, {.distance = 0.11}, one).value(),
               b = seal(model, {.distance = 0.11}, four).value();
    CHECK(a.arrangement.triangles == b.arrangement.triangles);
    CHECK(a.arrangement.vertices == b.arrangement.vertices);
    REQUIRE(a.changes.size() == b.changes.size());
    std::vector<std::uint32_t> faces(boundary.size());
    std::iota(faces.begin(), faces.end(), 3U);
    const auto cut = cut_to_volume(a.arrangement, faces);
    REQUIRE(cut);
    CHECK(volumes_of(cut.value().arrangement).block_count() == 4);
    CHECK(volumes_of(cut.value().arrangement).total == 512);
    CHECK(cut.value().report.borders.empty());
    check_rounds(cut.value().arrangement);
    // Repeating the restriction on the same surfaces and strips gives the same result.
    REQUIRE(cut.value().arrangement.state->restrict_again);
    const auto again =
        cut.value().arrangement.state->restrict_again(arrange(a.surfaces).value(), Run{});
    REQUIRE(again);
    CHECK(again.value().triangles == cut.value().arrangement.triangles);
    std::stop_source source;
    source.request_stop();
    one.stop = source.get_token();
    CHECK(seal(model, {.distance = 0.11}, one).error().code == ErrorCode::interrupted);
}
