// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/block_names.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/kernel/predicates.hpp>

using namespace terrane;
using namespace test_support;

namespace {

using NameList = std::vector<std::string>;

Surface having_role(Surface s, Role role) {
    s.role = role;
    return s;
}

Surface horizon_at(double z, const std::string& name) {
    return having_role(level(z, -1, -1, 9, 9, name), Role::horizon);
}

/// A vertical fault at `x`, from y0 to y1.
Surface fault_at(double x, double y0, double y1, const std::string& name) {
    return having_role(quad({x, y0, -1}, {x, y1, -1}, {x, y1, 9}, {x, y0, 9}, name), Role::fault);
}

Surface boundary_box() {
    return having_role(box({0, 0, 0}, {8, 8, 8}, "box"), Role::boundary);
}

terrane::Model named_model(const std::vector<Surface>& surfaces, const BlockNaming& naming = {}) {
    const auto exact = arranged(surfaces);
    auto rounded = round_to_doubles(exact);
    REQUIRE(rounded);
    REQUIRE(rounded->conforming);
    auto model = make_model(exact, *rounded->conforming, {}, naming);
    REQUIRE(model);
    return std::move(*model);
}

/// The names of the blocks, by their volumes.
NameList names_by_volume(const terrane::Model& model) {
    std::vector<std::pair<double, std::string>> named;
    for (std::size_t b = 1; b < model.structure.blocks.size(); ++b)
        named.emplace_back(model.structure.blocks[b].volume, model.structure.blocks[b].name);
    std::sort(named.begin(), named.end());
    NameList names;
    for (const auto& [volume, name] : named) names.push_back(name);
    return names;
}

/// The units of the blocks, by the blocks' volumes.
NameList units_by_volume(const terrane::Model& model) {
    std::vector<std::pair<double, std::string>> named;
    for (std::size_t b = 1; b < model.structure.blocks.size(); ++b)
        named.emplace_back(model.structure.blocks[b].volume, model.structure.blocks[b].unit);
    std::sort(named.begin(), named.end());
    NameList units;
    for (const auto& [volume, name] : named) units.push_back(name);
    return units;
}

BlockNaming by_column(StratigraphicColumn units) {
    return {.column = std::move(units)};
}

const StratigraphicColumn two_bases{{"Cover", "top"}, {"Reservoir", "base"}, {"Basement"}};

} // namespace

TEST_CASE("block names: by what bounds a block, as short as they differ", "[structure][names]") {
    // Layers of 1, 2 and 5; without a fault no side is named.
    const auto layers = named_model({boundary_box(), horizon_at(1, "base"), horizon_at(3, "top")});
    CHECK(names_by_volume(layers) == NameList{"below base", "below top, above base", "above top"});
    const auto faulted = named_model(
        {boundary_box(), horizon_at(1, "base"), horizon_at(3, "top"), fault_at(3.5, -1, 9, "F1")});
    CHECK(names_by_volume(faulted) == NameList{"below base, west of F1", "below base, east of F1",
                                               "below top, above base, west of F1",
                                               "below top, above base, east of F1",
                                               "above top, west of F1", "above top, east of F1"});
}

TEST_CASE("block names: do not depend on the order of surfaces", "[structure][names]") {
    std::vector<Surface> surfaces{boundary_box(), horizon_at(1, "base"), horizon_at(3, "top"),
                                  fault_at(3.5, -1, 9, "F1"), fault_at(6, -1, 9, "F2")};
    const NameList names = names_by_volume(named_model(surfaces));
    CHECK(std::set<std::string>(names.begin(), names.end()).size() == 9);
    std::reverse(surfaces.begin(), surfaces.end());
    CHECK(names_by_volume(named_model(surfaces)) == names);
    std::swap(surfaces[1], surfaces[3]);
    CHECK(names_by_volume(named_model(surfaces)) == names);
}

TEST_CASE("block names: closed bodies are inside or around", "[structure][names]") {
    const auto salt = cube(2, 3, "salt");
    const auto one = named_model({boundary_box(), salt});
    CHECK(names_by_volume(one) == NameList{"inside salt", "around salt"});
    CHECK(names_by_volume(named_model({boundary_box()})) == NameList{"inside the boundary"});
    const auto twice = named_model({having_role(cube(0, 1, "a"), Role::boundary),
                                    having_role(cube(3, 5, "b"), Role::boundary)});
    CHECK(names_by_volume(twice) == NameList{"inside the boundary", "inside the boundary, 2"});
}

TEST_CASE("block names: what is inside of two bodies that cross, and of one that others cut",
          "[structure][names]") {
    const auto crossing =
        named_model({box({0, 0, 0}, {4, 4, 4}, "a"), box({3, 3, 3}, {7, 7, 7}, "b")});
    CHECK(names_by_volume(crossing) == NameList{"inside a, inside b", "inside a", "inside b"});
    const auto cut = named_model(
        {boundary_box(), horizon_at(3, "top"), having_role(cube(2, 5, "salt"), Role::unknown)});
    CHECK(names_by_volume(cut) ==
          NameList{"below top, inside salt", "above top, inside salt", "below top", "above top"});
}

TEST_CASE("block names: a random point is inside of the bodies that its block's name says, and of "
          "no others at the block",
          "[structure][names]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-4, 4), size(1, 4);
    const auto point = [&] { return Point3{place(random), place(random), place(random)}; };
    for (int model_number = 0; model_number < cases(40); ++model_number) {
        INFO("model " << model_number);
        std::vector<Surface> bodies;
        for (const char* name : {"a", "b", "c", "d"}) {
            const Point3 centre = point();
            bodies.push_back(random() % 2 == 0
                                 ? octahedron(centre, size(random), name)
                                 : tetrahedron(point(), point(), point(), point(), name));
        }
        // An open surface cuts them.
        bodies.push_back(level(0.3, -9, -9, 9, 9, "top"));
        const auto model = named_model(bodies);
        std::vector<Point3> points;
        for (int i = 0; i < 500; ++i) points.push_back(point());
        const auto volumes = locate_points(points, model.mesh, model.volumes);
        REQUIRE(volumes);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::uint32_t block = (*volumes)[i];
            if (block == 0) continue;
            std::set<std::uint32_t> around;
            for (const std::uint32_t f : model.structure.blocks[block].interfaces)
                for (const std::uint32_t s : model.structure.interfaces[f].surfaces)
                    around.insert(s);
            const std::string& name = model.structure.blocks[block].name;
            INFO("point " << points[i].x << ' ' << points[i].y << ' ' << points[i].z << " in "
                          << name);
            for (std::uint32_t s = 0; s < 4; ++s) {
                // The bodies are convex: a point is inside if it is on one side of all triangles.
                std::set<Sign> sides;
                for (const auto& [a, b, c] : bodies[s].triangles) {
                    const auto& v = bodies[s].vertices;
                    sides.insert(orient3d(v[a], v[b], v[c], points[i]));
                }
                const bool is_inside = sides.size() == 1;
                const bool is_said = name.find("inside " + bodies[s].name) != std::string::npos;
                CHECK((is_said ? is_inside : !is_inside || !around.contains(s)));
            }
        }
    }
}

TEST_CASE("block names: units of a column, told apart by faults", "[structure][names]") {
    const auto layers =
        named_model({boundary_box(), horizon_at(1, "base"), horizon_at(3, "top")},
                    by_column({{"Cover", "top", 10.0}, {"Reservoir", "base", 60.5}, {"Basement"}}));
    CHECK(names_by_volume(layers) == NameList{"Basement", "Reservoir", "Cover"});
    for (const ModelBlock& block : layers.structure.blocks)
        CHECK(block.age == (block.unit == "Cover"       ? std::optional(10.0)
                            : block.unit == "Reservoir" ? std::optional(60.5)
                                                        : std::nullopt));
    const auto faulted = named_model(
        {boundary_box(), horizon_at(1, "base"), horizon_at(3, "top"), fault_at(3.5, -1, 9, "F1")},
        by_column(two_bases));
    CHECK(names_by_volume(faulted) == NameList{"Basement, west of F1", "Basement, east of F1",
                                               "Reservoir, west of F1", "Reservoir, east of F1",
                                               "Cover, west of F1", "Cover, east of F1"});
    CHECK(units_by_volume(faulted) ==
          NameList{"Basement", "Basement", "Reservoir", "Reservoir", "Cover", "Cover"});
}

TEST_CASE("block names: what is below the lowest base", "[structure][names]") {
    const auto model = named_model({boundary_box(), horizon_at(1, "base"), horizon_at(3, "top")},
                                   by_column({{"Cover", "top"}, {"Reservoir", "base"}}));
    CHECK(names_by_volume(model) == NameList{"below Reservoir", "Reservoir", "Cover"});
    // Without the horizon in the column the block between is of two units at once.
    const auto coarse = named_model({boundary_box(), horizon_at(1, "base")},
                                    by_column({{"Cover and reservoir", "base"}, {"Basement"}}));
    CHECK(names_by_volume(coarse) == NameList{"Basement", "Cover and reservoir"});
}

TEST_CASE("block names: a base that ends inside joins two units", "[structure][names]") {
    const auto model = named_model({boundary_box(), horizon_at(1, "base"),
                                    having_role(level(3, -1, -1, 4, 9, "top"), Role::horizon)},
                                   by_column(two_bases));
    CHECK(names_by_volume(model) == NameList{"Basement", "Cover to Reservoir"});
}

TEST_CASE("block names: an erosive base overrules the older ones that go through it",
          "[structure][names]") {
    // "old" dips through the level "base": the wedge of what is below it above "base" is Cover.
    const std::vector<Surface> surfaces{
        boundary_box(), horizon_at(4, "base"),
        having_role(quad({-1, -1, 1}, {9, -1, 6}, {9, 9, 6}, {-1, 9, 1}, "old"), Role::horizon)};
    const auto units = [&](UnitContact contact) {
        const auto model = named_model(
            surfaces, by_column({{"Cover", "base", {}, contact}, {"Old", "old"}, {"Basement"}}));
        auto all = units_by_volume(model);
        std::sort(all.begin(), all.end());
        return all;
    };
    CHECK(units(UnitContact::erosive) == NameList{"Basement", "Cover", "Cover", "Old"});
    CHECK(units(UnitContact::conformable) ==
          NameList{"Basement", "Cover", "Cover to Basement", "Old"});
}

TEST_CASE("columns: what is refused", "[structure][names]") {
    const auto refused = [](const StratigraphicColumn& units, const char* place,
                            const char* sentence) {
        const auto sound = check_column(units);
        REQUIRE_FALSE(sound);
        CHECK(sound.error().code == ErrorCode::bad_option);
        CHECK(sound.error().place == place);
        CHECK(sound.error().sentence == sentence);
    };
    CHECK(check_column(two_bases));
    refused({{"", "top"}}, "column[0].unit", "the unit needs a name");
    refused({{"A", "top"}, {"A"}}, "column[1].unit", "unit A is in the column twice");
    refused({{"A"}, {"B"}}, "column[0].surface", "only the lowest unit can be without a base");
    refused({{"A", "top"}, {"B", "top"}}, "column[1].surface",
            "surface top is the base of another unit");
    refused({{"A", "top", 2.0}, {"B", "base", 1.0}}, "column[1].age",
            "the base is younger than one above it");
    const std::vector<SurfaceInfo> surfaces{{"top", Role::horizon}, {"bsae", Role::horizon}};
    const auto unknown = check_column(two_bases, surfaces);
    REQUIRE_FALSE(unknown);
    CHECK(unknown.error().place == "column[1].surface");
    CHECK(unknown.error().sentence == "no surface is called base; did you mean bsae?");
}

TEST_CASE("stated blocks: match by their borders, whole or divided", "[structure][names]") {
    // The box is one border for each of its six sides: two triangles each.
    const auto side = [](std::uint32_t k) { return StatedBorder{SurfaceId(0), 2 * k, 2}; };
    const StatedBorder layer{SurfaceId(1), 0, 2};
    const auto model = [&](std::vector<Surface> more) {
        // All sides but the lowest and the highest are around both blocks.
        std::vector<StatedBlock> stated{
            {"lower", "Old", {side(0), side(2), side(3), side(4), side(5), layer}},
            {"upper", "New", {side(1), side(2), side(3), side(4), side(5), layer}}};
        std::vector<Surface> surfaces{boundary_box(), horizon_at(3, "top")};
        for (Surface& s : more) surfaces.push_back(std::move(s));
        return named_model(surfaces, {.stated = stated});
    };
    CHECK(names_by_volume(model({})) == NameList{"lower", "upper"});
    CHECK(units_by_volume(model({})) == NameList{"Old", "New"});
    CHECK(names_by_volume(model({fault_at(3.5, -1, 9, "F1")})) ==
          NameList{"lower, west of F1", "lower, east of F1", "upper, west of F1",
                   "upper, east of F1"});
    // A block of two stated ones has the name of neither.
    std::vector<StatedBlock> stated{{"lower", "", {side(0)}}, {"upper", "", {side(1)}}};
    CHECK(names_by_volume(named_model({boundary_box()}, {.stated = stated})) ==
          NameList{"inside the boundary"});
    // Borders beyond the triangles of a surface are passed over.
    stated = {{"lower", "", {{SurfaceId(0), 0, 13}, {SurfaceId(7), 0, 1}}}};
    CHECK(names_by_volume(named_model({boundary_box()}, {.stated = stated})) ==
          NameList{"inside the boundary"});
}
