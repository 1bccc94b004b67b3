// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares stacks of layers with heights at single points, computed from the input surfaces alone.
#include <terrane/algorithms/layers/layers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <stop_token>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "support/effort.hpp"
#include "support/paths.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/io/files.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Finds the triangle over x, y and the height there.
struct Hit {
    std::size_t triangle = 0;
    double z = 0;
};

template <class Owned>
std::optional<Hit> height_at(const std::vector<Point3>& vertices,
                             const std::vector<Triangle>& triangles, double x, double y,
                             const Owned& owned) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (!owned(t)) continue;
        const Point3 &a = vertices[triangles[t][0]], &b = vertices[triangles[t][1]],
                     &c = vertices[triangles[t][2]];
        const auto turn = [](const Point3& p, const Point3& q, double u, double v) {
            return (q.x - p.x) * (v - p.y) - (q.y - p.y) * (u - p.x);
        };
        const double whole = turn(a, b, c.x, c.y);
        const double u = turn(b, c, x, y) / whole, v = turn(c, a, x, y) / whole,
                     w = turn(a, b, x, y) / whole;
        if (u >= 0 && v >= 0 && w >= 0) return Hit{t, u * a.z + v * b.z + w * c.z};
    }
    return std::nullopt;
}

std::optional<double> height_of(const Surface& s, double x, double y) {
    const auto hit = height_at(s.vertices, s.triangles, x, y, [](std::size_t) { return true; });
    return hit ? std::optional(hit->z) : std::nullopt;
}

std::optional<Hit> height_of_layer(const Mesh& mesh, std::uint32_t layer, double x, double y) {
    return height_at(mesh.vertices, mesh.triangles, x, y, [&](std::size_t t) {
        const auto list = mesh.surfaces_of[t];
        return std::find(list.begin(), list.end(), layer) != list.end();
    });
}

/// Evaluates the definition at a point, from the hardest layer to the softest.
std::vector<std::optional<double>> expected_heights(const std::vector<Surface>& surfaces,
                                                    const std::vector<Layer>& order, double x,
                                                    double y, double thickness) {
    std::vector<std::size_t> by_hardness(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) by_hardness[i] = i;
    std::stable_sort(by_hardness.begin(), by_hardness.end(), [&](std::size_t a, std::size_t b) {
        return order[a].hardness > order[b].hardness;
    });
    std::vector<std::optional<double>> z(order.size());
    std::vector<bool> done(order.size(), false);
    for (const std::size_t i : by_hardness) {
        z[i] = height_of(surfaces[order[i].surface], x, y);
        std::optional<double> above, below;
        for (std::size_t j = i; j-- > 0;)
            if (done[j] && z[j]) {
                above = z[j];
                break;
            }
        for (std::size_t j = i + 1; j < order.size(); ++j)
            if (done[j] && z[j]) {
                below = z[j];
                break;
            }
        done[i] = true;
        if (!z[i]) continue;
        if (above) z[i] = std::min(*z[i], *above - thickness);
        if (below) z[i] = std::max(*z[i], *below + thickness);
        if (above) z[i] = std::min(*z[i], *above);
    }
    return z;
}

/// A number with enough bits for sums and products of these coordinates to be exact.
using Exactly = mpf_class;
constexpr unsigned exact_bits = 1024;

/// Computes six times the exact volume over z = 0.
Exactly volume_under(const Mesh& mesh, std::uint32_t layer) {
    const auto wide = [](double x) { return Exactly(x, exact_bits); };
    Exactly sum = wide(0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto list = mesh.surfaces_of[t];
        if (std::find(list.begin(), list.end(), layer) == list.end()) continue;
        const auto at = [&](unsigned k) { return mesh.vertices[mesh.triangles[t][k]]; };
        const Point3 a = at(0), b = at(1), c = at(2);
        const Exactly twice = (wide(b.x) - wide(a.x)) * (wide(c.y) - wide(a.y)) -
                              (wide(b.y) - wide(a.y)) * (wide(c.x) - wide(a.x));
        sum += abs(twice) * (wide(a.z) + wide(b.z) + wide(c.z));
    }
    return sum;
}

Mesh check_stack(const std::vector<Surface>& surfaces, const std::vector<Layer>& order,
                 const LayerOptions& options, std::mt19937_64& random) {
    const auto stacked = stack_layers(surfaces, order, options);
    if (!stacked) FAIL(stacked.error().message());
    const Mesh& mesh = stacked.value().rounded.mesh;
    REQUIRE(stacked.value().is_stack());
    // The exact test on surfaces: no two of them cross.
    std::vector<Surface> results(order.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t])
            results[s].triangles.push_back(mesh.triangles[t]);
    for (Surface& s : results) s.vertices = mesh.vertices;
    const auto report = check(results);
    REQUIRE(report);
    CHECK(report.value().clean());
    // Heights follow the definition; where two are equal, the triangles are equal.
    std::uniform_real_distribution<double> at(0, 10);
    for (int k = 0; k < 25; ++k) {
        const double x = at(random), y = at(random);
        const auto expected = expected_heights(surfaces, order, x, y, options.min_thickness);
        std::vector<std::optional<Hit>> hits;
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            hits.push_back(height_of_layer(mesh, i, x, y));
            REQUIRE(hits[i].has_value() == expected[i].has_value());
            if (hits[i]) CHECK(hits[i]->z == Approx(*expected[i]).margin(1e-9));
        }
        for (std::size_t i = 0; i < hits.size(); ++i)
            for (std::size_t j = i + 1; j < hits.size(); ++j) {
                if (!hits[i] || !hits[j]) continue;
                if (std::fabs(*expected[i] - *expected[j]) < 1e-13)
                    CHECK(hits[i]->triangle == hits[j]->triangle);
            }
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        CHECK(mesh.surfaces[i].name == surfaces[order[i].surface].name);
        CHECK(stacked.value().reports[i].surface == order[i].surface);
    }
    return mesh;
}

/// Builds a sheet of random waves around a level.
Surface random_sheet(std::mt19937_64& random, double level, unsigned n, double x0 = 0,
                     double x1 = 10) {
    std::uniform_real_distribution<double> amplitude(0.1, 0.8), wave(0.2, 1.2), phase(0, 6);
    const double a = amplitude(random), b = amplitude(random), p = phase(random), q = phase(random),
                 k = wave(random), l = wave(random);
    Surface s = sheet(graph([=](double x, double y) {
                          return level + a * std::sin(k * x + p) + b * std::cos(l * y + q);
                      }),
                      x0, 0, x1, 10, n, n + 1, 0.2, static_cast<unsigned>(random()));
    s.name = "level " + std::to_string(level);
    return s;
}

} // namespace

TEST_CASE("stacks: random stacks with crossings follow the definition", "[layers]") {
    std::mt19937_64 random(11);
    for (int i = 0; i < cases(40); ++i) {
        CAPTURE(i);
        const auto n = static_cast<std::uint32_t>(2 + i % 3);
        std::vector<Surface> surfaces;
        std::vector<Layer> order;
        std::uniform_int_distribution<int> hardness(0, 3);
        for (std::uint32_t s = 0; s < n; ++s) {
            surfaces.push_back(random_sheet(random, 0.4 * s, 5 + s + static_cast<unsigned>(i % 4)));
            order.push_back({SurfaceId(s), static_cast<double>(hardness(random))});
        }
        std::reverse(order.begin(), order.end()); // the highest level comes first
        const Mesh mesh = check_stack(surfaces, order, {}, random);
        std::vector<Exactly> volumes;
        for (std::uint32_t s = 0; s < n; ++s) volumes.push_back(volume_under(mesh, s));
        for (std::uint32_t s = 0; s + 1 < n; ++s) CHECK(volumes[s] >= volumes[s + 1]);
    }
}

TEST_CASE("stacks: layers of different outlines follow the definition and have steps", "[layers]") {
    std::mt19937_64 random(12);
    for (int i = 0; i < cases(8); ++i) {
        CAPTURE(i);
        const std::vector<Surface> surfaces{random_sheet(random, 0.3, 7, 1.03, 8.1),
                                            random_sheet(random, 0, 8, 2.51, 9.7),
                                            random_sheet(random, -0.3, 6, 0.2, 9.9)};
        check_stack(
            surfaces,
            {{SurfaceId(0), 1}, {SurfaceId(1), static_cast<double>(i % 4)}, {SurfaceId(2), 2}}, {},
            random);
    }
}

TEST_CASE("stacks: a minimum thickness is kept", "[layers]") {
    std::mt19937_64 random(13);
    for (int i = 0; i < cases(8); ++i) {
        CAPTURE(i);
        const std::vector<Surface> surfaces{
            random_sheet(random, 0.6, 6), random_sheet(random, 0.3, 7), random_sheet(random, 0, 5)};
        check_stack(
            surfaces,
            {{SurfaceId(0), 2}, {SurfaceId(1), static_cast<double>(i % 4)}, {SurfaceId(2), 1.5}},
            {.min_thickness = 0.125}, random);
    }
}

TEST_CASE("stacks: hard and soft layers, with the soft one above or below", "[layers]") {
    const Surface soft =
        sheet(graph([](double x, double) { return (x - 5) / 4; }), 0, 0, 10, 10, 9, 9);
    Surface hard = sheet(graph([](double, double) { return 0.0; }), 0, 0, 10, 10, 7, 7);
    hard.name = "hard";
    for (const Keep keep : {Keep::upper, Keep::lower}) {
        const auto result = harden(hard, soft, keep);
        REQUIRE(result);
        const Mesh& mesh = result.value().rounded.mesh;
        const std::uint32_t soft_at = keep == Keep::upper ? 0 : 1;
        CHECK(mesh.surfaces[1 - soft_at].name == "hard");
        for (const double x : {1.1, 3.3, 6.7, 9.1}) {
            const auto z = height_of_layer(mesh, soft_at, x, 4.3);
            REQUIRE(z);
            const double own = (x - 5) / 4;
            CHECK(z->z == Approx(keep == Keep::upper ? std::max(own, 0.0) : std::min(own, 0.0))
                              .margin(1e-12));
            CHECK(height_of_layer(mesh, 1 - soft_at, x, 4.3)->z == 0);
        }
        const LayerReport& report = result.value().reports[soft_at];
        CHECK(report.parts == 1);
        CHECK(report.dropped > 0);
        CHECK(report.taken_area == Approx(50));
        CHECK(report.dropped_area == Approx(50 * std::hypot(1, 0.25)));
        CHECK(report.largest_move == Approx(1.25));
        CHECK(report.step_length == 0);
        CHECK(result.value().reports[1 - soft_at].dropped == 0);
    }
}

TEST_CASE("stacks: layers that do not cross do not change, and stacking twice changes nothing more",
          "[layers]") {
    const Surface top =
        sheet(graph([](double x, double) { return 1 + 0.1 * x; }), 0, 0, 10, 10, 4, 4);
    const Surface base =
        sheet(graph([](double x, double) { return -0.1 * x; }), 0, 0, 10, 10, 5, 5);
    const auto apart = stack_layers(std::array{top, base},
                                    std::array{Layer{SurfaceId(0), 0}, Layer{SurfaceId(1), 1}});
    REQUIRE(apart);
    CHECK(apart.value().rounded.mesh->triangles.size() ==
          top.triangles.size() + base.triangles.size());
    for (const LayerReport& r : apart.value().reports) CHECK(r.dropped + r.taken == 0);

    std::mt19937_64 random(14);
    const std::array surfaces{random_sheet(random, 0.1, 8), random_sheet(random, 0, 9)};
    const std::array order{Layer{SurfaceId(0), 0}, Layer{SurfaceId(1), 1}};
    const auto once = stack_layers(surfaces, order);
    REQUIRE(once);
    CHECK(once.value().reports[0].dropped > 0);
    const Mesh& mesh = once.value().rounded.mesh;
    std::array<Surface, 2> again{};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t])
            again[s].triangles.push_back(mesh.triangles[t]);
    for (Surface& s : again) s.vertices = mesh.vertices;
    const auto twice = stack_layers(again, order);
    REQUIRE(twice);
    CHECK(twice.value().reports[0].dropped == 0);
    CHECK(twice.value().rounded.mesh->triangles.size() == mesh.triangles.size());
}

TEST_CASE("stacks: intersection points less than a spacing apart are merged, within the limit",
          "[layers]") {
    // The intersection curves of three layers cross at one point. Rounding inverts a triangle there.
    const auto surfaces = read_surfaces(test_data() + "/layers/stack436_crossings.obj");
    REQUIRE(surfaces);
    const std::array order{Layer{SurfaceId(0), 1}, Layer{SurfaceId(1), 5}, Layer{SurfaceId(2), 3}};
    const double spacing = std::nextafter(10.0, HUGE_VAL) - 10; // coordinates reach up to 10
    const auto stacked = stack_layers(*surfaces, order);
    REQUIRE(stacked);
    CHECK(stacked->is_stack());
    const RoundingReport& report = stacked->rounded.report;
    CHECK(report.max_move >= 4 * spacing);
    CHECK(report.surface_deviation >= 4 * spacing);
    CHECK(report.surface_deviation <= 40 * spacing);
    CHECK(report.max_allowed == 1024 * spacing);
    CHECK(stacked->step_width >= 2 * report.max_move);
    // The vertices of the input do not move.
    const Mesh& mesh = stacked->rounded.mesh;
    const auto is_kept = [&](const Point3& p) {
        return std::find(mesh.vertices.begin(), mesh.vertices.end(), p) != mesh.vertices.end();
    };
    const auto& hardest = surfaces->at(1).vertices;
    CHECK(std::all_of(hardest.begin(), hardest.end(), is_kept));

    // A smaller limit forbids the grid. The result then reports that layers are out of order.
    const auto held = stack_layers(*surfaces, order, {.max_move = 3 * spacing});
    REQUIRE(held);
    CHECK_FALSE(held->is_stack());
    CHECK(held->rounded.report.surface_deviation <= 3 * spacing);
    CHECK(held->rounded.report.max_allowed == 3 * spacing);
}

TEST_CASE("stacks: where the nearest harder layer has ended, the next one counts", "[layers]") {
    const auto flat = [](double x0, double x1, double level) {
        return sheet(graph([=](double, double) { return level; }), x0, 0, x1, 10, 4, 4);
    };
    // The middle layer ends at x = 5; the base rises above the top at x = 7.5.
    const std::array surfaces{
        flat(0, 10, 1), flat(0, 5, 0.5),
        sheet(graph([](double x, double) { return x / 5 - 0.5; }), 0, 0, 10, 10, 5, 5)};
    const auto stacked =
        stack_layers(surfaces, std::array{Layer{SurfaceId(0), 3}, Layer{SurfaceId(1), 2},
                                          Layer{SurfaceId(2), 1}});
    REQUIRE(stacked);
    CHECK(stacked->is_stack());
    CHECK(stacked->step_width < 1e-14);
    CHECK(stacked->reports[2].parts == 1);
    CHECK(stacked->reports[2].taken_area == Approx(25));
    CHECK(stacked->reports[2].largest_move == Approx(0.5));
    const Mesh& mesh = stacked->rounded.mesh;
    CHECK(height_of_layer(mesh, 2, 9.3, 4.1)->z == 1);
    CHECK(height_of_layer(mesh, 2, 6.1, 4.1)->z == Approx(6.1 / 5 - 0.5));
}

TEST_CASE("stacks: a soft layer has a step where the hard one ends, and its length is reported",
          "[layers]") {
    const Surface soft = sheet(graph([](double, double) { return -1.0; }), 0, 0, 10, 10, 10, 10);
    const Surface hard = sheet(graph([](double, double) { return 0.0; }), 2.5, 2.5, 7.5, 6.5, 5, 5);
    const auto result = harden(hard, soft, Keep::upper);
    REQUIRE(result);
    CHECK(result.value().rounded.report.clean);
    CHECK(result.value().reports[0].step_length == Approx(18));
    CHECK(result.value().reports[0].dropped_area == Approx(20));
    CHECK(result.value().reports[0].taken_area == Approx(20));
}

TEST_CASE("stacks: the result does not depend on the number of threads", "[layers]") {
    std::mt19937_64 random(15);
    const std::array surfaces{random_sheet(random, 0.1, 12), random_sheet(random, 0, 13)};
    const std::array order{Layer{SurfaceId(0), 0}, Layer{SurfaceId(1), 1}};
    const auto one = stack_layers(surfaces, order),
               three = stack_layers(surfaces, order, {}, {.threads = 3});
    REQUIRE(one);
    REQUIRE(three);
    CHECK(one.value().rounded.mesh->triangles == three.value().rounded.mesh->triangles);
    CHECK(one.value().rounded.mesh->vertices == three.value().rounded.mesh->vertices);
}

TEST_CASE("stacks: layers that can't be stacked are refused", "[layers]") {
    const Surface flat = sheet(graph([](double, double) { return 0.0; }), 0, 0, 10, 10, 4, 4);
    const auto code = [](const std::vector<Surface>& surfaces, const std::vector<Layer>& order,
                         const LayerOptions& options = {}) {
        const auto result = stack_layers(surfaces, order, options);
        REQUIRE(!result);
        return result.error().code;
    };
    CHECK(code({flat}, {}) == ErrorCode::nothing_to_do);
    CHECK(code({flat}, {{SurfaceId(1), 0}}) == ErrorCode::bad_option);
    CHECK(code({flat}, {{SurfaceId(0), 0}, {SurfaceId(0), 1}}) == ErrorCode::bad_option);
    CHECK(code({flat}, {{SurfaceId(0), std::nan("")}}) == ErrorCode::bad_option);
    CHECK(code({flat}, {{SurfaceId(0), 0}}, {.min_thickness = -1}) == ErrorCode::bad_option);
    SECTION("a vertical wall, an overturned fold") {
        const Surface wall = sheet(
            [](double u, double v) {
                return Point3{5, u, v - 5};
            },
            0, 0, 10, 10, 3, 3);
        CHECK(code({flat, wall}, {{SurfaceId(0), 1}, {SurfaceId(1), 0}}) == ErrorCode::unsupported);
        const Surface fold = sheet(
            [](double u, double v) {
                return Point3{5 + 2 * std::cos(u), v, 2 * std::sin(u) - 1};
            },
            -1.7, 1, 1.6, 9, 12, 4);
        for (const double hardness : {0.0, 2.0}) {
            Surface named = fold;
            named.name = "turned";
            const std::array<Surface, 2> two{named, flat};
            const auto result = stack_layers(
                two, std::array{Layer{SurfaceId(0), hardness}, Layer{SurfaceId(1), 1}});
            REQUIRE(!result);
            CHECK(result.error().code == ErrorCode::unsupported);
            CHECK(result.error().place.starts_with("turned ("));
        }
    }
    SECTION("a request to stop") {
        std::stop_source source;
        source.request_stop();
        Run run;
        run.stop = source.get_token();
        const std::array<Surface, 2> two{flat, flat};
        const auto result =
            stack_layers(two, std::array{Layer{SurfaceId(0), 0}, Layer{SurfaceId(1), 1}}, {}, run);
        REQUIRE(!result);
        CHECK(result.error().code == ErrorCode::interrupted);
    }
}
