// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/claim.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/check/check.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace {

using namespace terrane;
using test_support::surface;

CheckReport report_of(const std::vector<Surface>& surfaces) {
    auto report = check(surfaces);
    REQUIRE(report.ok());
    return std::move(report).value();
}

/// Returns the only contact of the triangle (0,0) (4,0) (0,4) in the plane z = 0 with another one.
ImproperContact contact_with(const Point3& a, const Point3& b, const Point3& c) {
    const auto report = report_of(
        {surface({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}), surface({a, b, c}, {{0, 1, 2}})});
    REQUIRE(report.contacts.size() == 1);
    CHECK_FALSE(report.clean());
    CHECK(report.contacts[0].triangles == std::array<std::uint32_t, 2>{0, 1});
    return report.contacts[0];
}

} // namespace

TEST_CASE("check: each kind of contact is named and located") {
    auto c = contact_with({2, 0, 0}, {2, -1, 1}, {3, -1, 1});
    CHECK(c.kind == ContactKind::vertex_on_edge);
    CHECK(c.place == Point3{2, 0, 0});
    c = contact_with({1, 1, 0}, {1, 2, 1}, {2, 1, 1});
    CHECK(c.kind == ContactKind::vertex_on_face);
    CHECK(c.place == Point3{1, 1, 0});
    c = contact_with({2, 0, -1}, {2, 0, 1}, {2, -3, 0});
    CHECK(c.kind == ContactKind::edges_cross);
    CHECK(c.place == Point3{2, 0, 0});
    CHECK(contact_with({1, 0, 0}, {3, 0, 0}, {2, -1, 1}).kind == ContactKind::edges_overlap);
    CHECK(contact_with({1, 1, 0}, {2, 1, 0}, {1, 1, 1}).kind == ContactKind::edge_on_face);
    CHECK(contact_with({1, 1, -1}, {1, 1, 1}, {2, 1, 1}).kind == ContactKind::crossing);
    CHECK(contact_with({0, 0, 0}, {1, 1, 1}, {1, 1, -1}).kind == ContactKind::crossing);
    CHECK(contact_with({1, 1, 0}, {9, 1, 0}, {1, 9, 0}).kind == ContactKind::coplanar_overlap);
    CHECK(contact_with({0, 0, 0}, {4, 0, 0}, {1, 1, 0}).kind == ContactKind::coplanar_overlap);
}

TEST_CASE("check: conforming surfaces are clean") {
    const std::vector<Point3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const auto report = report_of({surface(square, {{0, 1, 2}, {0, 2, 3}}),
                                   surface({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}})});
    CHECK(report.clean());
    CHECK(report.surfaces == 2);
    CHECK(report.triangles == 3);
    CHECK(report.vertices == 5);
    CHECK(report.free_border_edges == 7); // four of the square, three of the triangle
    CHECK(report.components == 1);
    CHECK(report.non_manifold_edges.empty());
}

TEST_CASE("check: degenerate, repeated and shared triangles") {
    const std::vector<Point3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    const auto report = report_of(
        {surface(p, {{0, 1, 2}, {0, 1, 3}, {1, 1, 2}, {2, 1, 0}}), surface(p, {{1, 2, 0}})});
    CHECK(report.degenerate == std::vector<std::uint32_t>{1, 2});
    REQUIRE(report.repeated.size() == 1);
    CHECK(report.repeated[0] == std::array<std::uint32_t, 2>{3, 0});
    REQUIRE(report.shared.size() == 1);
    CHECK(report.shared[0] == std::array<std::uint32_t, 2>{4, 0});
    CHECK_FALSE(report.clean());
    CHECK(report_of({surface(p, {{0, 1, 2}}), surface(p, {{1, 2, 0}})}).clean());
}

TEST_CASE("check: an edge with three triangles of one surface is listed, and is no flaw") {
    const auto report = report_of({surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                           {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})});
    REQUIRE(report.non_manifold_edges.size() == 1);
    CHECK(report.non_manifold_edges[0] == std::array<Point3, 2>{Point3{0, 0, 0}, Point3{1, 0, 0}});
    CHECK(report.clean());
}

TEST_CASE("check: what no stage may be given") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto bad = surface({{0, 0, 0}, {1, 0, nan}, {0, 1, 0}}, {{0, 1, 2}});
    bad.name = "top";
    const auto number = check(std::vector{bad});
    REQUIRE_FALSE(number.ok());
    CHECK(number.error().code == ErrorCode::bad_number);
    CHECK(number.error().place == "surface top, vertex 1");
    bad.vertices[1] = {1, 0, 0};
    bad.triangles.push_back({0, 1, 3});
    const auto index = check(std::vector{bad});
    REQUIRE_FALSE(index.ok());
    CHECK(index.error().code == ErrorCode::bad_index);
    CHECK(index.error().place == "surface top, triangle 1");
    std::stop_source stop;
    stop.request_stop();
    Run run;
    run.stop = stop.get_token();
    const auto stopped = check(std::vector{surface(bad.vertices, {{0, 1, 2}})}, run);
    REQUIRE_FALSE(stopped.ok());
    CHECK(stopped.error().code == ErrorCode::interrupted);
}

TEST_CASE("check: the progress of the search ascends, and a stop request ends the search") {
    const Surface waves = test_support::sheet_of( // 80 000 triangles, each next to a few others
        200, 200, 1.0, [](int, int) { return true; },
        [](double x, double y) {
            return Point3{x, y, std::fmod(x * y, 7) / 16};
        });
    std::vector<double> shares;
    std::stop_source stop;
    Run run;
    run.progress = [&](std::string_view stage, double share) {
        CHECK(stage == "check");
        shares.push_back(share);
    };
    REQUIRE(check(std::vector{waves}, run).ok());
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(std::ranges::count_if(shares, [](double s) { return s < 0.3; }) >= 4);
    CHECK(shares.back() == 1);

    double last = 0;
    run.stop = stop.get_token();
    run.progress = [&](std::string_view, double share) {
        last = share;
        stop.request_stop();
    };
    const auto stopped = check(std::vector{waves}, run);
    REQUIRE_FALSE(stopped.ok());
    CHECK(stopped.error().code == ErrorCode::interrupted);
    CHECK(last <= 0.3);
}
