// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The key "uncertainty" of project files.
#include <catch2/catch.hpp>

#include <string>

#include <nlohmann/json.hpp>

#include <terrane/io/project.hpp>

using namespace terrane;
using json = nlohmann::json;

namespace {

json uncertain_document() {
    json made = json::parse(R"({"format": "terrane-project 1", "surfaces": [{"file": "a"}],
                                "outputs": {"blocks": "obj"}})");
    made["uncertainty"] = json::parse(
        R"([{"surface": "top", "group": "velocity", "tilt": 0.5,
             "field": {"model": "matern", "smoothness": 2.5, "range": 800, "azimuth": 30, "ratio": 0.5,
                       "sd": 10}},
            {"surface": "base", "field": {"range": 800, "map": "sd.asc"}, "shift": 5},
            {"surface": "sea", "field": {"model": "spherical", "range": 90, "sd": "kriging"}},
            {"surface": "F1", "dip": 2, "throw": 30, "throw_reach": 1000}])");
    return made;
}

Result<Project> parsed(const json& document) {
    return parse_project(document.dump(), "/data", "p.json");
}

} // namespace

TEST_CASE("project: what is uncertain is read, and mistakes are named", "[io][project]") {
    const auto read = parsed(uncertain_document()).value().uncertainty;
    REQUIRE(read.size() == 4);
    CHECK(read[0].surface == "top");
    CHECK(read[0].group == "velocity");
    CHECK(read[0].tilt == 0.5);
    CHECK(read[0].field->model == "matern");
    CHECK(read[0].field->smoothness == 2.5);
    CHECK(read[0].field->range == 800);
    CHECK(read[0].field->azimuth == 30);
    CHECK(read[0].field->ratio == 0.5);
    CHECK(read[0].field->sd == 10.0);
    CHECK(read[1].field->map == "/data/sd.asc");
    CHECK(read[1].field->model == "gaussian");
    CHECK(read[1].shift == 5);
    CHECK(read[2].field->kriging);
    CHECK(read[3].dip == 2);
    CHECK(read[3].slip == 30);
    CHECK(read[3].reach == 1000.0);
    const auto with = [](const char* pointer, const json& value) {
        json document = uncertain_document();
        document[json::json_pointer(pointer)] = value;
        const auto made = parsed(document);
        return made ? std::string("no error") : made.error().message();
    };
    const std::string at = "p.json: uncertainty";
    CHECK(with("/uncertainty/0/field/sd", "much") ==
          at + "[0].field.sd: must be kriging or a number larger than 0");
    CHECK(with("/uncertainty/0/field/map", "sd.asc") ==
          at + "[0].field: must have one of the keys sd and map");
    CHECK(with("/uncertainty/0/field/smoothness", 2) ==
          at + "[0].field.smoothness: must be 1.5 or 2.5");
    CHECK(with("/uncertainty/0/field/ratio", 1.5) == at + "[0].field.ratio: must be at most 1");
    CHECK(with("/uncertainty/0/field/model", "power") ==
          at + "[0].field.model: must be spherical, exponential, gaussian or matern");
    CHECK(with("/uncertainty/0/tilt", 50) == at + "[0].tilt: must be at most 45 degrees");
    CHECK(with("/uncertainty/3", {{"surface", "F1"}, {"throw_reach", 5}, {"dip", 1}}) ==
          at + "[3].throw_reach: needs throw, whose reach it is");
    CHECK(with("/uncertainty/3", {{"surface", "F1"}}) ==
          at + "[3]: must have at least one of the keys field, shift, tilt, dip and throw");
}
