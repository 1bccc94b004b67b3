// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane build` with holes to fill and layers to order, from outside.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "holed_fold.hpp"
#include "program.hpp"

using namespace program_test;

namespace {

double sheet_at(double x, double y) {
    return 40 + 0.25 * x - 0.125 * y;
}

/// Returns a sheet over [0, 230] x [0, 230] as an Irap grid of depths, with two round holes.
std::string holed_grid() {
    std::string text = "-996 24 10 10\n0 230 0 230\n24 0 0 0\n0 0 0 0 0 0 0\n";
    for (int j = 0; j < 24; ++j)
        for (int i = 0; i < 24; ++i) {
            const bool hole = std::hypot(i - 7, j - 8) < 2.5 || std::hypot(i - 16, j - 15) < 4.2;
            text += hole ? "9999900 " : std::to_string(-sheet_at(10.0 * i, 10.0 * j)) + "\n";
        }
    return text;
}

Json grid_project(const std::string& method) {
    auto json = Json::parse(R"({
        "format": "terrane-project 1",
        "surfaces": [{"file": "top.irap", "role": "horizon", "depth": true}],
        "fill": [{"surface": "top"}],
        "volume_of_interest": {"box": {"low": [10, 10, 0], "high": [220, 220, 120]}},
        "outputs": {"surfaces": ["obj"], "blocks": "obj"}})");
    json["fill"][0]["method"] = method;
    return json;
}

/// Shale rises through flat salt, so that the order is wrong in one half. A bore wall is in no
/// layer.
const std::string crossing_horizons = polygon("shale", "0 0 -4, 8 0 4, 8 8 4, 0 8 -4") +
                                      polygon("salt", "0 0 0, 8 0 0, 8 8 0, 0 8 0");

Json layer_project(const char* upper, const char* lower) {
    auto json = Json::parse(R"({
        "format": "terrane-project 1",
        "surfaces": [{"file": "stack.obj", "role": "horizon"}],
        "layers": {"order": []},
        "volume_of_interest": {"box": {"low": [0, 0, -5], "high": [8, 8, 5]}},
        "outputs": {"surfaces": ["obj"], "blocks": "obj"}})");
    for (const char* name : {upper, lower})
        json["layers"]["order"].push_back(
            {{"surface", name}, {"hardness", std::string(name) == "salt" ? 2 : 1}});
    return json;
}

struct MendingCase {
    Folder folder;

    MendingCase() {
        folder.input("top.irap", holed_grid());
        folder.input("fold.obj", test_support::holed_fold_as_obj());
        folder.input("stack.obj", crossing_horizons);
    }
    [[nodiscard]] Outcome build(const Json& json, const std::string& arguments) const {
        return folder.run("build " + folder.input("p.json", json.dump(2)) + " " + arguments);
    }
    [[nodiscard]] Json built(const Json& json, const std::string& to) const {
        const auto r = build(json, "-o " + to);
        INFO(r.err);
        REQUIRE(r.status == 0);
        return Json::parse(folder.read(to + "/statistics.json"));
    }
};

std::vector<double> sorted_blocks(const Json& statistics) {
    auto blocks = statistics["volumes"]["blocks"].get<std::vector<double>>();
    std::sort(blocks.begin(), blocks.end());
    return blocks;
}

} // namespace

TEST_CASE("cli: build fills holes, so that what they let through becomes two blocks", "[cli]") {
    const MendingCase c;
    auto open = grid_project("kriging");
    open.erase("fill");
    CHECK(c.built(open, "open")["volumes"]["blocks"].size() == 1);
    for (const std::string method : {"kriging", "rbf"}) {
        const auto statistics = c.built(grid_project(method), method);
        // Volume below the plane: the area times the height in the middle.
        const double below = 210.0 * 210 * sheet_at(115, 115), all = 210.0 * 210 * 120;
        const auto blocks = sorted_blocks(statistics);
        REQUIRE(blocks.size() == 2);
        CHECK(blocks[0] == Approx(std::min(below, all - below)).epsilon(1e-6));
        CHECK(blocks[1] == Approx(std::max(below, all - below)).epsilon(1e-6));
        REQUIRE(statistics["holes"].size() == 2);
        std::size_t points = 0;
        for (const Json& hole : statistics["holes"]) {
            CHECK(hole["surface"] == "top");
            CHECK(hole["filled"]["area"].get<double>() > 0);
            points += hole["filled"]["interpolated"].get<std::size_t>();
        }
        CHECK(statistics["seconds"].contains("fill"));
        CHECK(statistics["constants"].contains(method));
        CHECK_FALSE(statistics["constants"].contains(method == "rbf" ? "kriging" : "rbf"));
        const auto csv = c.folder.read(method + "/interpolated.csv");
        CHECK(std::size_t(std::count(csv.begin(), csv.end(), '\n')) == points + 1);
        CHECK(c.folder.read(method + "/filled.svg").starts_with("<svg"));
        CHECK(contains(c.folder.read(method + "/log.txt"), "filled 2 of 2 holes: "));
    }
}

TEST_CASE("cli: build with fill makes what fill and then build make", "[cli][once]") {
    const MendingCase c;
    for (const std::string method : {"kriging", "rbf"}) {
        const auto filled =
            c.folder.run("fill --depth in/top.irap -o in/" + method + ".ts --method " + method);
        INFO(filled.err);
        REQUIRE(filled.status == 0);
        auto apart = grid_project(method);
        apart.erase("fill");
        apart["surfaces"] = Json::array({{{"file", method + ".ts"}, {"role", "horizon"}}});
        (void)c.built(apart, method + "_apart");
        (void)c.built(grid_project(method), method);
        CHECK(c.folder.read(method + "/surfaces.obj") ==
              c.folder.read(method + "_apart/surfaces.obj"));
    }
}

TEST_CASE("cli: build: holes that are not wanted stay open", "[cli]") {
    const MendingCase c;
    auto json = grid_project("kriging");
    json["fill"][0]["max_area"] = 3000;
    json["fill"][0]["surface"] = "horizon"; // by its role
    const auto statistics = c.built(json, "out");
    CHECK(statistics["volumes"]["blocks"].size() == 1);
    CHECK_FALSE(statistics["holes"][0].contains("filled"));
    CHECK(statistics["holes"][1].contains("filled"));
}

TEST_CASE("cli: build puts layers in order, with the volumes that follow", "[cli][layer]") {
    const MendingCase c;
    auto json = layer_project("shale", "salt");
    const auto stacked = c.built(json, "upper");
    // Salt stays flat, and shale becomes the higher of the two: a wedge over half of it.
    const auto blocks = sorted_blocks(stacked);
    REQUIRE(blocks.size() == 3);
    CHECK(blocks == std::vector<double>{64, 256, 320});
    REQUIRE(stacked["layers"].size() == 2);
    CHECK(stacked["layers"][0]["name"] == "shale");
    CHECK(stacked["layers"][0]["taken_area"].get<double>() == Approx(32));
    CHECK(stacked["layers"][1]["dropped"] == 0);
    CHECK(contains(c.folder.read("upper/log.txt"), "shale: "));
    CHECK(contains(c.folder.read("upper/surfaces.obj"), "g shale salt"));
    json.erase("layers");
    CHECK(c.built(json, "crossed")["volumes"]["blocks"].size() == 4);
    // With a thickness, the wedge continues as a sheet of 0.5 over all of salt where shale is
    // lower.
    json = layer_project("shale", "salt");
    json["layers"]["min_thickness"] = 0.5;
    const auto thick = sorted_blocks(c.built(json, "thick"));
    REQUIRE(thick.size() == 3);
    CHECK(thick[0] == Approx(8 * (0.5 * 4.5 + (0.5 + 4) / 2 * 3.5)));
    CHECK(thick[2] == Approx(320));
    CHECK(sorted_blocks(c.built(layer_project("salt", "shale"), "lower")) == blocks);
}

TEST_CASE("cli: build fills first, then puts in order; the same for any number of threads",
          "[cli][layer]") {
    const MendingCase c;
    // The filled sheet dips below a floor on one side.
    c.folder.input("floor.obj", "o floor\nv 0 0 60\nv 230 0 60\nv 230 230 60\nv 0 230 60\n"
                                "f 1 2 3 4\n");
    auto json = grid_project("kriging");
    json["surfaces"].push_back({{"file", "floor.obj"}, {"role", "horizon"}});
    json["layers"] = Json::parse(R"({"order": [{"surface": "top", "hardness": 1},
                                               {"surface": "floor", "hardness": 2}]})");
    REQUIRE(c.build(json, "-o one --threads 1").status == 0);
    REQUIRE(c.build(json, "-o two --threads 2").status == 0);
    CHECK(c.folder.shell("diff -r -x log.txt -x statistics.json one two").status == 0);
    const auto statistics = Json::parse(c.folder.read("one/statistics.json"));
    const auto blocks = sorted_blocks(statistics);
    REQUIRE(blocks.size() >= 3); // above, between, below: between may be in parts
    double sum = 0;
    for (const double v : blocks) sum += v;
    CHECK(sum == Approx(210.0 * 210 * 120));
    // The block below the floor keeps its volume, as the floor is the hardest.
    CHECK(std::any_of(blocks.begin(), blocks.end(),
                      [](double v) { return v == Approx(210.0 * 210 * 60); }));
}

TEST_CASE("cli: build: what can't be mended is named, and nothing is written", "[cli]") {
    const MendingCase c;
    const auto refused = [&](const Json& json, const std::string& reason, int status) {
        const auto r = c.build(json, "-o out");
        INFO(r.err);
        CHECK(r.status == status);
        CHECK(contains(r.err, reason));
        CHECK(c.folder.left().empty());
    };
    auto json = grid_project("kriging");
    json["fill"][0]["surface"] = "base";
    refused(json, "in/p.json: fill[0].surface: no surface is called base", 2);
    json["surfaces"][0]["role"] = "fault";
    json["fill"][0]["surface"] = "horizon";
    refused(json, "in/p.json: fill[0].surface: no surface has the role horizon", 2);
    json = grid_project("kriging");
    json["fill"].push_back({{"surface", "horizon"}});
    refused(json, "in/p.json: fill[1].surface: top is in an entry before this one", 2);
    json = grid_project("kriging");
    json["surfaces"] = Json::array({{{"file", "fold.obj"}, {"name", "top"}}});
    refused(json, "hole 1 of top is left open: ", 1);
    json = layer_project("shale", "slate");
    refused(json, "in/p.json: layers.order[1].surface: no surface is called slate", 2);
    json = layer_project("shale", "shale");
    refused(json, "in/p.json: layers.order[1].surface: shale is in the order twice", 2);
    json = layer_project("shale", "salt");
    json["surfaces"].push_back({{"file", "stack.obj"}, {"objects", Json::array({"salt"})}});
    refused(json, "2 surfaces are called salt", 2);
    // An overturned horizon can't be in a stack; the error names it and a place.
    c.folder.input("flat.obj", "o flat\nv -50 0 0\nv 300 0 0\nv 300 240 0\nv -50 240 0\n"
                               "f 1 2 3 4\n");
    json = layer_project("fold", "flat");
    json["surfaces"] = Json::array({{{"file", "fold.obj"}}, {{"file", "flat.obj"}}});
    refused(json, "fold (", 2);
    refused(json, "is above and below another along one vertical", 2);
}
