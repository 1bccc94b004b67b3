// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include "sections_of_models.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// A box of 4 x 4 x 4, divided by a horizon at 2 and, above 1, by a fault at x = 1.
SectionModel faulted_model() {
    return section_model({level(2, -1, -1, 5, 5, "horizon"),
                          quad({1, -1, 1}, {1, 5, 1}, {1, 5, 5}, {1, -1, 5}, "fault")},
                         *box_boundary({0, 0, 0}, {4, 4, 4}));
}

WellLog log_of(const SectionModel& model, std::vector<Point3> points) {
    const auto logs =
        log_wells(model.mesh, model.volumes, std::array{WellPath{"A", std::move(points)}});
    REQUIRE(message_of(logs) == "no error");
    REQUIRE(logs->size() == 1);
    CHECK((*logs)[0].name == "A");
    return (*logs)[0];
}

/// "2 horizon" for each marker: its depth and surface.
std::vector<std::string> markers_of(const WellLog& log, const Mesh& mesh) {
    std::vector<std::string> texts;
    for (const WellMarker& m : log.markers) {
        std::string depth = std::to_string(m.depth);
        depth.erase(depth.find_last_not_of('0') + 1);
        if (depth.back() == '.') depth.pop_back();
        texts.push_back(depth + " " + mesh.surfaces[m.surface].name);
    }
    return texts;
}

std::vector<double> depths_of(const WellLog& log) {
    std::vector<double> depths{log.intervals.front().from};
    for (const WellInterval& in : log.intervals) {
        CHECK(in.from == depths.back());
        depths.push_back(in.to);
    }
    return depths;
}

using Texts = std::vector<std::string>;
using Depths = std::vector<double>;

ErrorCode refusal(const SectionModel& model, const WellPath& path) {
    const auto logs = log_wells(model.mesh, model.volumes, std::array{path});
    REQUIRE(!logs);
    return logs.error().code;
}

} // namespace

TEST_CASE("wells: a vertical one meets blocks and surfaces in order") {
    const SectionModel model = faulted_model();
    const WellLog log = log_of(model, {{2, 2.5, 6}, {2, 2.5, -1}});
    CHECK(depths_of(log) == Depths{0, 2, 4, 6, 7});
    CHECK(markers_of(log, model.mesh) == Texts{"2 boundary top", "4 horizon", "6 boundary bottom"});
    CHECK(log.intervals[0].blocks == std::vector<std::uint32_t>{0});
    CHECK(log.intervals[3].blocks == std::vector<std::uint32_t>{0});
    CHECK(model.volumes.measures[log.intervals[1].blocks.at(0)] == 24); // east of the fault
    CHECK(model.volumes.measures[log.intervals[2].blocks.at(0)] == 32);
    CHECK(log.intervals[1].entry == Point3{2, 2.5, 4});
    CHECK(log.intervals[1].exit == Point3{2, 2.5, 2});
    CHECK((log.markers[1].before == 1 && log.markers[1].after == 2));
    const WellLog upwards = log_of(model, {{2, 2.5, -1}, {2, 2.5, 6}});
    CHECK(depths_of(upwards) == Depths{0, 1, 3, 5, 7});
}

TEST_CASE("wells: a surface that ends within a block is met, and divides nothing") {
    const SectionModel model = faulted_model();
    const WellLog log = log_of(model, {{-1, 2, 1.5}, {5, 2, 1.5}});
    CHECK(depths_of(log) == Depths{0, 1, 5, 6});
    const auto markers = markers_of(log, model.mesh);
    REQUIRE(markers.size() == 3);
    CHECK(markers[1] == "2 fault");
    CHECK((log.markers[1].before == 1 && log.markers[1].after == 1));
    const WellLog along_tip = log_of(model, {{1, 1, 1}, {1, 3, 1}});
    REQUIRE(along_tip.intervals.size() == 1);
    CHECK(along_tip.intervals[0].blocks.size() == 1);
    CHECK(along_tip.intervals[0].surfaces.size() == 1);
}

TEST_CASE("wells: a part in a surface is an interval of its own") {
    const SectionModel model = faulted_model();
    const WellLog log = log_of(model, {{0.5, 2, 3}, {0.5, 2, 2}, {3, 2, 2}, {3, 2, 0.5}});
    CHECK(depths_of(log) == Depths{0, 1, 1.5, 3.5, 5});
    CHECK(markers_of(log, model.mesh) == Texts{"1 horizon", "1.5 fault", "3.5 horizon"});
    for (const std::size_t k : {1U, 2U}) {
        CHECK(log.intervals[k].blocks.size() == 2);
        REQUIRE(log.intervals[k].surfaces.size() == 1);
        CHECK(model.mesh.surfaces[log.intervals[k].surfaces[0]].name == "horizon");
    }
    CHECK(log.intervals[0].surfaces.empty());
    // Where horizon and fault meet there are three blocks, and on an edge of the box one.
    const WellLog branch = log_of(model, {{1, 1, 2}, {1, 3, 2}});
    REQUIRE(branch.intervals.size() == 1);
    CHECK(branch.intervals[0].blocks.size() == 3);
    CHECK(branch.intervals[0].surfaces.size() == 2);
    const WellLog edge = log_of(model, {{0, 0, 0.5}, {0, 0, 1.5}});
    REQUIRE(edge.intervals.size() == 1);
    CHECK(edge.intervals[0].blocks.size() == 2);
    CHECK(edge.intervals[0].blocks[0] == 0);
    // From corner to corner, and one that touches a corner from outside.
    CHECK(depths_of(log_of(model, {{4, 4, 4}, {0, 0, 0}})).size() == 3);
    const WellLog touching = log_of(model, {{-1, 1, 4}, {1, -1, 4}});
    CHECK(touching.intervals.size() == 1);
    CHECK(touching.markers.size() == 3); // the sides of the box that meet there
}

TEST_CASE("wells: depths are those of the points, repeated points count once") {
    const SectionModel model = faulted_model();
    const WellPath path{"B", {{2, 2, 6}, {2, 2, 5}, {2, 2, 5}, {2, 2, 1}}, {100, 110, 110, 150}};
    const auto logs = log_wells(model.mesh, model.volumes, std::array{path});
    REQUIRE(logs);
    CHECK(depths_of((*logs)[0]) == Depths{100, 120, 140, 150});
}

TEST_CASE("wells: without volumes, and without triangles, all is outside") {
    const SectionModel model = faulted_model();
    const WellPath path{"C", {{2, 2.5, 6}, {2, 2.5, -1}}};
    const auto logs = log_wells(model.mesh, Volumes{}, std::array{path});
    REQUIRE(logs);
    CHECK((*logs)[0].intervals.size() == 1);
    CHECK((*logs)[0].markers.size() == 3);
    const auto none = log_wells(Mesh{}, Volumes{}, std::array{path});
    REQUIRE(none);
    CHECK((*none)[0].intervals.size() == 1);
    CHECK((*none)[0].markers.empty());
}

TEST_CASE("wells: what makes no sense is refused") {
    SectionModel model = faulted_model();
    const auto code = [&](std::vector<Point3> points, std::vector<double> depths = {}) {
        return refusal(model, {"D", std::move(points), std::move(depths)});
    };
    CHECK(code({}) == ErrorCode::bad_option);
    CHECK(code({{1, 1, 1}, {1, 1, 1}}) == ErrorCode::bad_option);
    CHECK(code({{1, 1, 1}, {1, 1, NAN}}) == ErrorCode::bad_option);
    CHECK(code({{1, 1, 1}, {1, 1, 2}}, {0}) == ErrorCode::bad_option);
    CHECK(code({{1, 1, 1}, {1, 1, 2}}, {0, 0}) == ErrorCode::bad_option);
    CHECK(code({{1, 1, 1}, {1, 1, 2}}, {1, 0}) == ErrorCode::bad_option);
    CHECK(code({{1, 1, 1}, {1, 1, 2}}, {1, INFINITY}) == ErrorCode::bad_option);
    CHECK(code({{1, 1, 1}, {1, 1, 1}, {1, 1, 2}}, {0, 1, 2}) == ErrorCode::bad_option);
    Run stopped;
    std::stop_source stop;
    stop.request_stop();
    stopped.stop = stop.get_token();
    const WellPath path{"E", {{2, 2.5, 6}, {2, 2.5, -1}}};
    const auto interrupted = log_wells(model.mesh, model.volumes, std::array{path}, stopped);
    REQUIRE(!interrupted);
    CHECK(interrupted.error().code == ErrorCode::interrupted);
    for (auto& sides : model.volumes.of_sides) std::swap(sides[0], sides[1]);
    CHECK(refusal(model, path) == ErrorCode::improper_contact);
    model.volumes.of_sides.pop_back();
    CHECK(refusal(model, path) == ErrorCode::improper_contact);
}

TEST_CASE("wells: surveys by minimum curvature") {
    const auto end_of = [](std::vector<WellStation> stations) {
        const auto path = surveyed_path("S", {10, 20, 30}, stations);
        REQUIRE(message_of(path) == "no error");
        CHECK(path->points.size() == path->depths.size());
        CHECK(path->points.front() == Point3{10, 20, 30});
        CHECK(path->depths.front() == 0);
        CHECK(path->depths.back() == stations.back().depth);
        return path->points.back();
    };
    const auto is_near = [](const Point3& p, const Point3& q) {
        return length(minus(p, q)) < 1e-9;
    };
    CHECK(is_near(end_of({{0, 0, 0}, {100, 0, 0}}), {10, 20, -70}));
    CHECK(is_near(end_of({{100, 0, 77}}), {10, 20, -70})); // vertical above the first station
    CHECK(is_near(end_of({{0, 30, 90}, {100, 30, 90}}), {60, 20, 30 - 50 * std::numbers::sqrt3}));
    CHECK(is_near(end_of({{0, 90, 0}, {50, 90, 360}}), {10, 70, 30}));
    // A quarter of a circle of radius 100 to the east, in one step and in many.
    const double quarter = 50 * std::numbers::pi;
    CHECK(is_near(end_of({{0, 0, 90}, {quarter, 90, 90}}), {110, 20, -70}));
    std::vector<WellStation> many{{0, 0, 90}};
    for (int i = 1; i <= 90; ++i) many.push_back({quarter * i / 90, double(i), 90});
    CHECK(is_near(end_of(many), {110, 20, -70}));
    // A quarter in the map: from north to east at the depth of the head.
    CHECK(is_near(end_of({{0, 90, 0}, {quarter, 90, 90}}), {110, 120, 30}));
    // Angles so small that the series counts, beside the straight line.
    CHECK(is_near(end_of({{0, 10, 0}, {100, 10 + 1e-7, 0}}), end_of({{0, 10, 0}, {100, 10, 0}})) ==
          false);
    const auto refused = [](std::vector<WellStation> stations) {
        const auto path = surveyed_path("S", {}, stations);
        return !path && path.error().code == ErrorCode::bad_option;
    };
    CHECK(refused({}));
    CHECK(refused({{-1, 0, 0}}));
    CHECK(refused({{0, 0, 0}, {0, 0, 0}}));
    CHECK(refused({{0, 0, 0}, {9, 181, 0}}));
    CHECK(refused({{0, 0, 0}, {9, -1, 0}}));
    CHECK(refused({{0, NAN, 0}}));
    CHECK(refused({{0, 90, 0}, {9, 90, 180}}));
    CHECK(!surveyed_path("S", {NAN, 0, 0}, std::array{WellStation{9, 0, 0}}));
}
