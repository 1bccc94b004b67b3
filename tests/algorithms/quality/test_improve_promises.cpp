// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The promises of improve() about whole models: volumes of blocks, the worst triangle, the order of
// files, sizes where a surface is curved, and distances.
#include <terrane/algorithms/quality/improve.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/io/files.hpp>

#include "support/improve_cases.hpp"
#include "support/paths.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"

using namespace terrane;
using namespace test_support;
using namespace improve_cases;

namespace {

std::vector<Surface> read_all(const std::vector<std::string>& names) {
    std::vector<Surface> all;
    for (const std::string& name : names) {
        const auto read = read_surfaces(test_data() + "/improve/" + name + ".obj");
        REQUIRE(read);
        all.insert(all.end(), read->begin(), read->end());
    }
    return all;
}

using Place = std::array<double, 3>;

/// The triangles by the places of their corners, in no particular order.
std::multiset<std::array<Place, 3>> geometry_of(const Mesh& mesh) {
    std::multiset<std::array<Place, 3>> all;
    for (const Triangle& t : mesh.triangles) {
        std::array<Place, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3& p = mesh.vertices[t[i]];
            corners[i] = {p.x, p.y, p.z};
        }
        std::sort(corners.begin(), corners.end());
        all.insert(corners);
    }
    return all;
}

double largest_change(const Improved& better) {
    double largest = 0;
    for (std::size_t b = 1; b < better.volume_before.size(); ++b)
        largest = std::max(largest,
                           std::fabs(better.volumes.measures[b] /
                                         better.volumes_before.measures[better.volume_before[b]] -
                                     1));
    return largest;
}

} // namespace

TEST_CASE("improve: a thin block keeps its volume", "[improve]") {
    const Mesh mesh = mesh_of(read_all({"thin_block"}));
    ImproveOptions options;
    options.edge_length = 150;
    const Improved better = improved(mesh, options);
    REQUIRE(better.report.sides_kept);
    REQUIRE(better.volume_before.size() > 1);
    CHECK(better.report.thin_triangles > 0);
    CHECK(largest_change(better) < 0.2);
    options.thickness_share = 1e6; // the bound does not know of the block
    const Improved held = improved(mesh, options);
    CHECK(held.report.thin_triangles == 0);
    CHECK(held.report.attempts > 1);
    CHECK(held.report.held_blocks > 0);
    CHECK(largest_change(held) <= 0.05);
    options.max_volume_change = 1e9;
    const Improved loose = improved(mesh, options);
    CHECK(loose.report.held_blocks == 0);
    CHECK(largest_change(loose) > 1);
}

TEST_CASE("improve: blocks between waves keep their volumes, as far as is asked", "[improve]") {
    // Thin lenses between sheets of the same shape that have other triangles.
    const auto wave = [](double off) {
        return [off](double u, double v) {
            return Point3{4 * u, 4 * v, 0.3 * std::sin(7 * u) * std::cos(6 * v) + off};
        };
    };
    const Mesh mesh =
        mesh_of({unit_grid(13, 9, wave(0), "low"), unit_grid(8, 11, wave(0.002), "mid"),
                 unit_grid(13, 9, wave(0.01), "high")});
    double before = 0;
    for (const double most : {1e9, 5.0, 0.5}) {
        ImproveOptions options;
        options.edge_length = 0.4;
        options.thickness_share = 10; // the bound is hardly limited by distances
        options.max_volume_change = most;
        const Improved better = improved(mesh, options);
        REQUIRE(better.report.sides_kept);
        INFO(most << ": " << better.volume_before.size() << " volumes");
        if (most > 5) {
            before = largest_change(better);
            CHECK(before > 0.05); // otherwise the test would be too easy
            CHECK(better.report.attempts == 1);
        } else {
            CHECK(100 * largest_change(better) <= most);
            CHECK(better.report.held_blocks > 0);
        }
        CHECK(better.report.after.q.min >= better.report.before.q.min * (1 - 1e-12));
    }
}

TEST_CASE("improve: a block is thin between sheets, not where they cross", "[improve]") {
    const auto crossing = [](double slope) {
        return mesh_of({sheet(graph([](double, double) { return 0.0; }), 0, 0, 10, 10, 12, 12),
                        sheet(graph([=](double x, double) { return slope * (x - 5.1); }), 0, 0, 10,
                              10, 7, 8)});
    };
    ImproveOptions options;
    options.edge_length = 1;
    options.max_deviation = 0.2;
    CHECK(improved(crossing(0.1), options).report.thin_triangles > 0);
    const Improved steep = improved(crossing(1), options);
    CHECK(steep.report.thin_triangles == 0);
    CHECK(steep.report.after.q.min > 0.3);
}

TEST_CASE("improve: the worst triangle is never worse than the worst one before", "[improve]") {
    ImproveOptions slab, model;
    slab.edge_length = 50;
    model.edge_length = 50.5293;
    model.max_deviation = 0.0067506;
    model.turn = 22;
    model.crease_angle = 115;
    for (const auto& [names, options] :
         {std::pair(std::vector<std::string>{"thin_slab"}, slab),
          std::pair(std::vector<std::string>{"worst_b0", "worst_b1", "worst_s0", "worst_s1"},
                    model)}) {
        const Improved better = improved(mesh_of(read_all(names)), options);
        INFO(names[0]);
        CHECK(better.report.after.q.min >= better.report.before.q.min * (1 - 1e-12));
    }
}

TEST_CASE("improve: good triangles stay good, unless worse ones are allowed", "[improve]") {
    const auto wave = [](double u, double v) {
        return Point3{10 * u, 10 * v, 0.4 * std::sin(5 * u) * std::cos(4 * v)};
    };
    const Mesh mesh = mesh_of({unit_grid(20, 20, wave, "wave")});
    unsigned attempts = 0;
    for (const double length : {0.25, 0.6, 1.1}) {
        const Improved strict = improved(mesh, {.edge_length = length});
        const QualityReport &before = strict.report.before, &after = strict.report.after;
        INFO(length << ": " << before.q.min << " -> " << after.q.min);
        REQUIRE(before.q.min > 0.6);
        CHECK(after.q.min >= before.q.min * (1 - 1e-12));
        CHECK(strict.report.least_quality == Approx(before.q.min).epsilon(1e-11));
        attempts = std::max(attempts, strict.report.attempts);
        const Improved loose = improved(mesh, {.edge_length = length, .least_quality = 0.3});
        CHECK(loose.report.after.q.min >= 0.3);
        CHECK(loose.report.after.q.mean > 0.9);
        CHECK(std::fabs(loose.report.after.edge_length.mean - length) <
              std::fabs(after.edge_length.mean - length) + 0.1 * length);
    }
    CHECK(attempts > 1); // otherwise the test would be too easy
}

TEST_CASE("improve: an inner vertex of three triangles goes where it makes the worst ones",
          "[improve]") {
    Surface s{"flat",
              Role::horizon,
              {{0, 0, 0}, {4, 0, 0}, {2, 3.5, 0}, {2, 0.0001, 0}},
              {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const Improved better = improved(mesh_of({s}), {.edge_length = 4});
    CHECK(better.report.after.q.min > 0.9);
    CHECK(better.mesh->triangles.size() == 1);
}

TEST_CASE("improve: the order of files, vertices and triangles changes nothing", "[improve]") {
    auto surfaces = read_all({"order_f0", "order_h0", "order_h1", "order_h2"});
    const Mesh mesh = mesh_of(surfaces);
    const auto geometry = geometry_of(improved(mesh).mesh);
    CHECK(geometry != geometry_of(mesh));
    for (unsigned turn = 0; turn < 3; ++turn) {
        std::rotate(surfaces.begin(), surfaces.begin() + 1, surfaces.end());
        for (Surface& s : surfaces) std::reverse(s.triangles.begin(), s.triangles.end());
        CHECK(geometry_of(improved(mesh_of(surfaces)).mesh) == geometry);
    }
    // Each sheet keeps the orientation of its first triangle.
    Mesh turned = mesh;
    for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
    const Improved plain = improved(mesh), other = improved(turned);
    REQUIRE(plain.mesh->triangles.size() == other.mesh->triangles.size());
    for (std::size_t t = 0; t < plain.mesh->triangles.size(); ++t) {
        const Triangle &a = plain.mesh->triangles[t], &b = other.mesh->triangles[t];
        const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
        CHECK(b[(at + 2) % 3] == a[1]);
    }
}

TEST_CASE("improve: slivers along an intersection do not count as curvature", "[improve]") {
    const auto horizon = read_all({"turn_horizon"}), fault = read_all({"turn_fault"});
    ImproveOptions options;
    options.edge_length = 100;
    options.turn = 20;
    const auto triangles = [&](const std::vector<Surface>& surfaces) {
        const Improved better = improved(mesh_of(surfaces), options);
        return surface_of_mesh(better.mesh, 0).triangles.size();
    };
    const auto alone = triangles(horizon), cut = triangles({horizon[0], fault[0]});
    CHECK(cut < alone * 13 / 10);
}

TEST_CASE("deviation: the measured distance is within 5 % of the true one", "[improve]") {
    const auto tent = [](double at, double narrow) {
        return graph([=](double x, double y) {
            return std::max(0.0, 1 - narrow * std::hypot(x - at, y - at));
        });
    };
    const Surface flat = sheet(graph([](double, double) { return 0.0; }), 0, 0, 10, 10, 3, 3);
    // No corner, middle or other usual sample of the flat triangles is near the peak.
    const Surface peak = sheet(tent(5.37, 4), 0, 0, 10, 10, 61, 61);
    const double highest =
        std::max_element(peak.vertices.begin(), peak.vertices.end(),
                         [](const Point3& a, const Point3& b) { return a.z < b.z; })
            ->z;
    CHECK(measured_distance(peak, flat) >= 0.95 * highest);
    CHECK(measured_distance(peak, flat) <= highest * (1 + 1e-12));
    const double back = measured_distance(flat, peak);
    CHECK(back <= distance_bound(flat, peak, 1e-3));
    CHECK(back >= 0.95 * (distance_bound(flat, peak, 1e-3) - 1e-3));
    CHECK(measured_distance(flat, flat) == Approx(0).margin(1e-12));
    Surface high = flat;
    for (Point3& p : high.vertices) p.z += 0.5;
    CHECK(measured_distance(high, flat) == Approx(0.5));
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    CHECK(measured_distance(peak, flat, run) == 0);
}

TEST_CASE("deviation: the measured distance agrees with a proven bound", "[improve]") {
    for (unsigned k = 0; k < 8; ++k) {
        const auto wave = [&](double off) {
            return [=](double u, double v) {
                return Point3{8 * u, 8 * v + off, std::sin(5 * u + k) * std::cos(4 * v + off)};
            };
        };
        const Surface fine = unit_grid(11 + k, 13, wave(0), "fine"),
                      coarse = unit_grid(5, 3 + k, wave(k % 2 == 0 ? 0 : 0.3), "coarse");
        for (const auto& [from, to] : {std::pair(fine, coarse), std::pair(coarse, fine)}) {
            const double measured = measured_distance(from, to),
                         bound = distance_bound(from, to, 0.004);
            CHECK(measured <= bound * (1 + 1e-12));
            CHECK(measured >= 0.95 * (bound - 0.004));
            CHECK(measured >= 0.95 * sampled_distance(from, to));
        }
    }
}

TEST_CASE("deviation: small distances are measured as quickly as large ones", "[improve]") {
    // By radii alone, some 1e12 parts would be needed.
    const auto flat = [](double off) {
        return [=](double u, double v) { return Point3{1e3 * u, 1e3 * v, off * std::sin(9 * u)}; };
    };
    const Surface one = unit_grid(40, 37, flat(0), "one"),
                  other = unit_grid(31, 50, flat(1e-4), "other");
    const double measured = measured_distance(one, other);
    CHECK(measured > 0.9e-4);
    CHECK(measured < 1.01e-4);
}

TEST_CASE("improve: options are judged before the work", "[improve]") {
    const auto surfaces = read_all({"large_f0", "large_h0", "large_h1", "large_h2"});
    const Mesh mesh = mesh_of(surfaces);
    ImproveOptions options;
    options.max_deviation = 1e-12;
    const auto refused = improve(mesh, options);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::bad_option);
    const auto at = refused.error().sentence.find("the least is ");
    REQUIRE(at != std::string::npos);
    const double least = std::stod(refused.error().sentence.substr(at + 13));
    options.max_deviation = 0.9 * least;
    CHECK_FALSE(check_improvable(surfaces, options));
    options.max_deviation = 1.1 * least;
    CHECK(check_improvable(surfaces, options));

    const std::vector<Surface> flat{
        sheet(graph([](double, double) { return 0.0; }), 0, 0, 10, 10, 3, 3)};
    const double expected = 100 / (std::sqrt(3.0) / 4 * 0.25);
    CHECK(check_improvable(flat, {.edge_length = 0.5, .max_triangles = expected * 1.001}));
    CHECK_FALSE(check_improvable(flat, {.edge_length = 0.5, .max_triangles = expected * 0.999}));
    CHECK(check_improvable(flat, {.max_triangles = 18}));
    CHECK_FALSE(check_improvable(flat, {.max_triangles = 17}));
    const auto many = improve(mesh_of(flat), {.edge_length = 0.5, .max_triangles = 500});
    REQUIRE_FALSE(many);
    CHECK(many.error().sentence.find("triangles are to be expected") != std::string::npos);
    const Improved enough = improved(mesh_of(flat), {.edge_length = 0.5, .max_triangles = 1500});
    CHECK(static_cast<double>(enough.mesh->triangles.size()) == Approx(expected).epsilon(0.25));
}
