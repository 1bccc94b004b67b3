// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that realisations of a project move its surfaces as the project states.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/uncertainty/realisations.hpp>

#include "support/shapes.hpp"

using namespace terrane;

namespace {

Surface flat(const std::string& name, Role role, const std::vector<Point3>& corners) {
    return {name, role, corners, {{0, 1, 2}, {0, 2, 3}}};
}

/// Two horizons, and a fault that dips by 45 degrees to greater x between them.
std::vector<Surface> flat_model() {
    return {flat("top", Role::horizon, {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}}),
            flat("base", Role::horizon, {{0, 0, -50}, {40, 0, -50}, {40, 100, -50}, {0, 100, -50}}),
            flat("F", Role::fault, {{40, 10, 10}, {40, 90, 10}, {80, 90, -30}, {80, 10, -30}})};
}

Result<Realisations> prepared(std::vector<ProjectUncertainty> uncertainty,
                              const std::vector<std::optional<Surface>>& maps = {}) {
    Project project;
    project.source = "p.json";
    project.uncertainty = std::move(uncertainty);
    return Realisations::prepare(project, {.surfaces = flat_model()}, maps);
}

ProjectUncertainty entry(const std::string& surface) {
    ProjectUncertainty u;
    u.surface = surface;
    return u;
}

ProjectField field_of(double range, std::optional<double> sd) {
    ProjectField f;
    f.range = range;
    f.sd = sd;
    return f;
}

/// The root of the mean square of what `of` says of many realisations.
template <class Of>
double deviation(const Realisations& all, const Of& of) {
    constexpr int n = 4000;
    double squares = 0;
    for (int i = 1; i <= n; ++i) {
        const double value = of(all.input_of(7, static_cast<std::uint64_t>(i)).surfaces);
        squares += value * value / n;
    }
    return std::sqrt(squares);
}

constexpr double tolerance = 0.056; ///< five standard errors of a deviation of 4000 values

std::string refusal(const std::vector<ProjectUncertainty>& uncertainty,
                    const std::vector<std::optional<Surface>>& maps = {}) {
    const auto made = prepared(uncertainty, maps);
    return made ? "" : made.error().message();
}

} // namespace

TEST_CASE("realisations: number 0 is the model, and each is made again alone", "[uncertainty]") {
    auto top = entry("top"), fault = entry("F");
    top.field = field_of(50, 3);
    fault.shift = 4;
    const auto all = prepared({top, fault}), again = prepared({top, fault});
    REQUIRE(all);
    REQUIRE(again);
    const auto vertices = [](const Realisations& of, std::uint64_t seed, std::uint64_t number) {
        std::vector<Point3> points;
        for (const Surface& s : of.input_of(seed, number).surfaces)
            points.insert(points.end(), s.vertices.begin(), s.vertices.end());
        return points;
    };
    std::vector<Point3> given;
    for (const Surface& s : flat_model())
        given.insert(given.end(), s.vertices.begin(), s.vertices.end());
    CHECK(vertices(*all, 1, 0) == given);
    const auto third = vertices(*again, 1, 3); // without the two before
    vertices(*all, 1, 1);
    vertices(*all, 1, 2);
    CHECK(vertices(*all, 1, 3) == third);
    CHECK(vertices(*all, 1, 4) != third);
    CHECK(vertices(*all, 2, 3) != third);
    const auto base = all->input_of(1, 3).surfaces[1].vertices;
    CHECK(base == flat_model()[1].vertices); // to the last bit
    CHECK(all->project().uncertainty.empty());
}

TEST_CASE("realisations: shift, tilt, dip and field have their standard deviations",
          "[uncertainty]") {
    auto top = entry("top");
    top.shift = 3;
    const auto shifted = prepared({top});
    CHECK(deviation(*shifted, [](const auto& s) { return s[0].vertices[2].z; }) ==
          Approx(3).epsilon(tolerance));
    top.shift = 0;
    top.tilt = 2;
    const auto tilted = prepared({top});
    const double slope = 2 * 3.14159265358979 / 180;
    CHECK(deviation(*tilted, [](const auto& s) {
              return (s[0].vertices[1].z - s[0].vertices[0].z) / 100;
          }) == Approx(slope).epsilon(tolerance));
    CHECK(deviation(*tilted, [](const auto& s) {
              return (s[0].vertices[3].z - s[0].vertices[0].z) / 100;
          }) == Approx(slope).epsilon(tolerance));
    auto fault = entry("F");
    fault.dip = 3;
    const auto turned = prepared({fault});
    const auto dip = [](const std::vector<Surface>& s) {
        const Point3 &a = s[2].vertices[0], &b = s[2].vertices[3];
        return std::atan2(a.z - b.z, b.x - a.x) * 180 / 3.14159265358979 - 45;
    };
    CHECK(deviation(*turned, dip) == Approx(3).epsilon(tolerance));
    const auto one = turned->input_of(7, 1).surfaces[2].vertices; // it turns about its middle
    CHECK(one[0].x + one[2].x == Approx(120));
    CHECK(one[0].z + one[2].z == Approx(-20));
    CHECK(one[0].y == Approx(10));
    fault.dip = 0;
    fault.field = field_of(1e9, 5); // the same everywhere
    const auto moved = prepared({fault});
    CHECK(deviation(*moved, [](const auto& s) {
              return ((s[2].vertices[0].x - 40) + (s[2].vertices[0].z - 10)) / std::sqrt(2.0);
          }) == Approx(5).epsilon(tolerance));
    const auto across = moved->input_of(7, 1).surfaces[2].vertices[0]; // along the normal
    CHECK(across.x - 40 == Approx(across.z - 10));
    CHECK(across.y == 10);
}

TEST_CASE("realisations: the throw of a fault lowers what is above it and abreast of it",
          "[uncertainty]") {
    auto fault = entry("F");
    fault.slip = 6;
    Project project;
    project.uncertainty = {fault};
    // Points of a horizon above the fault, below it, and off its ends.
    std::vector<Surface> surfaces = flat_model();
    surfaces.push_back({"points",
                        Role::horizon,
                        {{70, 50, 0}, {30, 50, 0}, {70, 200, 0}, {60, 50, 10}},
                        {{0, 1, 3}, {0, 2, 3}}});
    const auto all = Realisations::prepare(project, {.surfaces = surfaces}, {});
    REQUIRE(all);
    CHECK(deviation(*all, [](const auto& s) { return s[3].vertices[0].z; }) ==
          Approx(6).epsilon(tolerance));
    fault.reach = 40;
    project.uncertainty = {fault};
    const auto fading = Realisations::prepare(project, {.surfaces = surfaces}, {});
    const auto whole = all->input_of(7, 5).surfaces[3].vertices;
    const auto less = fading->input_of(7, 5).surfaces[3].vertices;
    CHECK(whole[1] == surfaces[3].vertices[1]);
    CHECK(whole[2] == surfaces[3].vertices[2]);
    CHECK(whole[3].z - 10 == Approx(whole[0].z));
    const double distance = 20 / std::sqrt(2.0); // from (70, 50, 0) to x + z = 50
    CHECK(less[0].z == Approx(whole[0].z * (1 - distance / 40)));
}

TEST_CASE("realisations: groups move alike, names apart, and a map scales the field",
          "[uncertainty]") {
    auto top = entry("top"), base = entry("base");
    top.shift = 2;
    base.shift = 4;
    const auto apart = prepared({top, base});
    top.group = base.group = "velocity";
    const auto alike = prepared({top, base});
    const auto moves = [](const Realisations& of, std::uint64_t i) {
        const auto s = of.input_of(1, i).surfaces;
        return std::pair(s[0].vertices[0].z, s[1].vertices[0].z + 50);
    };
    double together = 0;
    for (std::uint64_t i = 1; i <= 1000; ++i) {
        const auto [a, b] = moves(*apart, i);
        together += a * b / 8 / 1000;
        const auto both = moves(*alike, i);
        CHECK(both.second == Approx(2 * both.first).margin(1e-12));
    }
    CHECK(std::fabs(together) < 5 / std::sqrt(1000.0));
    auto mapped = entry("top");
    mapped.field = field_of(1e9, std::nullopt); // the same number everywhere, times the map
    const Surface map =
        flat("sd", Role::unknown, {{0, 0, 0}, {100, 0, 10}, {100, 100, 10}, {0, 100, 0}});
    const auto scaled = prepared({mapped}, {map});
    REQUIRE(scaled);
    CHECK(deviation(*scaled, [](const auto& s) { return s[0].vertices[1].z; }) ==
          Approx(10).epsilon(tolerance));
    CHECK(scaled->input_of(1, 1).surfaces[0].vertices[0].z == 0);
}

TEST_CASE("realisations: what does not move is found once for all", "[uncertainty]") {
    Project project;
    project.uncertainty = {entry("base")};
    project.uncertainty[0].shift = 0.01;
    std::vector<Surface> surfaces;
    for (const std::string name : {"top", "base"})
        surfaces.push_back(test_support::grid(
            6, 6,
            [&](double x, double y) {
                return Point3{x, y, name == "top" ? 0.1 : -2.0};
            },
            name));
    surfaces.push_back(test_support::grid(
        6, 6,
        [](double x, double y) {
            return Point3{x, 2.5, y - 3.3};
        },
        "F"));
    const auto all = Realisations::prepare(project, {.surfaces = surfaces}, {});
    REQUIRE(all);
    for (const std::uint64_t number : {1, 2, 3}) {
        const auto made = all->build(7, number);
        const auto alone = build(all->project(), all->input_of(7, number));
        REQUIRE(made);
        REQUIRE(alone);
        CHECK((made->arranged.exact.statistics.known > 0) == (number > 1));
        CHECK(alone->arranged.exact.statistics.known == 0);
        CHECK(made->model->mesh->vertices == alone->model->mesh->vertices);
        CHECK(made->model->mesh->triangles == alone->model->mesh->triangles);
    }
}

TEST_CASE("realisations: what cannot move as stated is an error with its key", "[uncertainty]") {
    auto wrong = entry("tpo");
    wrong.shift = 1;
    CHECK(refusal({wrong}) ==
          "p.json: uncertainty[0].surface: no surface is called tpo; did you mean top?");
    auto top = entry("top"), fault = entry("F");
    top.shift = 1;
    CHECK(refusal({top, top}) == "p.json: uncertainty[1].surface: top is in an entry before");
    fault.tilt = 1;
    CHECK(refusal({fault}) == "p.json: uncertainty[0].tilt: F is a fault: state dip instead");
    top.dip = 1;
    CHECK(refusal({top}) == "p.json: uncertainty[0].dip: top is no fault; its role can be set in "
                            "surfaces");
    auto kriged = entry("top");
    kriged.field = field_of(10, std::nullopt);
    kriged.field->kriging = true;
    CHECK(refusal({kriged}) ==
          "p.json: uncertainty[0].field.sd: kriging is for surfaces in which the "
          "key fill fills holes by kriging");
    auto mapped = entry("top");
    mapped.field = field_of(10, std::nullopt);
    const Surface map =
        flat("sd", Role::unknown, {{0, 0, -1}, {100, 0, -1}, {100, 100, -1}, {0, 100, -1}});
    CHECK(refusal({mapped}, {map}) ==
          "p.json: uncertainty[0].field.map: has values below 0, which are "
          "no standard deviations");
    auto faults = entry("fault"), horizons = entry("horizon"); // all of a role
    faults.shift = horizons.shift = 1;
    CHECK(refusal({faults, horizons}).empty());
}
