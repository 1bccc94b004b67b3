// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Project files: the parser, and the schema, which must agree with it.
#include <terrane/io/project.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "support/paths.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;
using nlohmann::json;

namespace {

json schema() {
    std::ifstream file(source_dir() + "/io/project.schema.json");
    return json::parse(file);
}

/// Returns a document with every key except those of the other kinds of volumes.
json full() {
    return json::parse(R"({
        "format": "terrane-project 1", "folder": "run", "threads": 2, "unit": "m",
        "surfaces": [{"file": "a.ts", "objects": ["top", "base"], "role": "horizon"},
                     {"file": "/b.ts", "objects": ["x"], "name": "F1", "role": "fault", "depth": true}],
        "column": [{"unit": "New", "surface": "top", "age": 20.5, "contact": "erosive"},
                   {"unit": "Old"}],
        "fill": [{"surface": "top", "method": "rbf", "model": "power", "max_area": 1000,
                  "mesh_size": 2.5, "gap_slope": 0.5, "bridge_faults": true,
                  "smoothing": 0.25},
                 {"surface": "base", "smoothing": "auto"}, {"surface": "salt"}],
        "layers": {"order": [{"surface": "top", "hardness": 1.5},
                             {"surface": "base", "hardness": -2}], "min_thickness": 0.5},
        "volume_of_interest": {"box": {"low": [0, 0, -1.5], "high": [1, 2, 3]}},
        "tolerance": 0.125, "extend": 100, "seal": 0.25, "seal_of": {"top": 0, "top/base": 3}, "min_volume": 2.5, "max_move": 0.5,
        "improve": {"edge_length": 4, "max_deviation": 0.125, "edge_length_of": {"top": 3},
                    "layers_in_gaps": 0.5, "smallest": 0.25, "resolution": 1.5, "dissolve": true},
        "tetrahedra": {"edge_length": 2, "max_volume": 3.5, "quality": 1.4, "split_surfaces": true,
                       "size_of": {"F1": 0.5, "top": 1}, "size_in": {"2": 0.25, "top/base": 1},
                       "split": ["fault", "top"], "outside": true, "time_limit": 60, "mesher": "gmsh", "optimise": false,
                       "order": 2, "refine_bad": 3, "move_vertices": false},
        "outputs": {"surfaces": ["vtp", "obj"], "tetrahedra": ["vtu", "msh", "msh22"],
                    "blocks": "vtp", "certificate": false, "gocad": true}})");
}

/// Returns full documents that together have every key of the schema.
std::vector<json> samples() {
    const std::vector<std::string> volumes{
        R"({"rotated_box": {"centre": [1, 2, 3], "lengths": [4, 5, 6], "azimuth": 30,
                            "plunge": 5, "roll": -7}})",
        R"({"rotated_box": {"corner": [1, 2, 3], "lengths": [4, 5, 6]}})",
        R"({"polygon": {"corners": [[0, 0], [1, 0], [0, 1]], "between": [-5, 0]}})",
        R"({"within": ["salt.ts", "lid.ts"]})"};
    std::vector<json> all{full()};
    for (const auto& volume : volumes) {
        all.push_back(full());
        all.back()["volume_of_interest"] = json::parse(volume);
    }
    all.push_back(full());
    for (const char* key : {"unit", "improve", "fill", "layers", "tolerance", "min_volume"})
        all.back().erase(key);
    all.back()["outputs"]["certificate"] = true;
    all.back()["tetrahedra"]["order"] = 1;
    all.back()["surfaces"][1]["depth"] = false;
    all.push_back(json::parse(R"({"format": "terrane-project 1", "surfaces": [{"file": "a"}],
                                  "outputs": {"blocks": "obj"}})"));
    all.push_back(all.back());
    all.back()["uncertainty"] = json::parse(
        R"([{"surface": "top", "group": "velocity", "tilt": 0.5,
             "field": {"model": "matern", "smoothness": 2.5, "range": 800, "azimuth": 30, "ratio": 0.5,
                       "sd": 10}},
            {"surface": "base", "field": {"range": 800, "map": "sd.asc"}, "shift": 5},
            {"surface": "sea", "field": {"model": "spherical", "range": 90, "sd": "kriging"}},
            {"surface": "F1", "dip": 2, "throw": 30, "throw_reach": 1000}])");
    return all;
}

Result<Project> parse(const json& document) {
    return parse_project(document.dump(), "/data", "p.json");
}

std::string message(const json& document) {
    return message_of(parse(document));
}

/// Judges a value by a keyword of JSON Schema that bounds it; none if the keyword is another one.
std::optional<bool> within_bound(const std::string& word, const json& rule, const json& value) {
    if (word == "minLength") return !value.is_string() || value.get<std::string>().size() >= rule;
    if (word == "minimum") return !value.is_number() || value >= rule;
    if (word == "maximum") return !value.is_number() || value <= rule;
    if (word == "exclusiveMinimum") return !value.is_number() || value > rule;
    if (word == "minItems") return !value.is_array() || value.size() >= rule;
    if (word == "maxItems") return !value.is_array() || value.size() <= rule;
    if (word == "minProperties") return !value.is_object() || value.size() >= rule;
    if (word == "maxProperties") return !value.is_object() || value.size() <= rule;
    return std::nullopt;
}

bool has_type(const json& type, const json& value) {
    return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
           (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
           (type == "number" && value.is_number()) ||
           (type == "integer" && value.is_number_integer());
}

/// Judges a value by the part of JSON Schema that the schema uses; other keywords fail the test.
bool holds(const json& schema, const json& value) {
    for (const auto& [word, rule] : schema.items()) {
        if (const auto bound = within_bound(word, rule, value)) {
            if (!*bound) return false;
        } else if (word == "type") {
            if (!has_type(rule, value)) return false;
        } else if (word == "enum") {
            if (std::find(rule.begin(), rule.end(), value) == rule.end()) return false;
        } else if (word == "required") {
            if (value.is_object())
                for (const auto& key : rule)
                    if (!value.contains(key.get<std::string>())) return false;
        } else if (word == "dependentRequired") {
            for (const auto& [key, needed] : rule.items())
                if (value.is_object() && value.contains(key))
                    for (const auto& other : needed)
                        if (!value.contains(other.get<std::string>())) return false;
        } else if (word == "items") {
            if (value.is_array())
                for (const auto& entry : value)
                    if (!holds(rule, entry)) return false;
        } else if (word == "properties") {
            if (value.is_object())
                for (const auto& [key, inner] : rule.items())
                    if (value.contains(key) && !holds(inner, value[key])) return false;
        } else if (word == "additionalProperties") {
            if (value.is_object())
                for (const auto& [key, inner] : value.items()) {
                    if (schema.contains("properties") && schema["properties"].contains(key))
                        continue;
                    if (rule == false || !holds(rule, inner)) return false;
                }
        } else if (word == "anyOf") {
            if (std::none_of(rule.begin(), rule.end(),
                             [&](const json& one) { return holds(one, value); }))
                return false;
        } else if (word == "oneOf") {
            if (std::count_if(rule.begin(), rule.end(),
                              [&](const json& one) { return holds(one, value); }) != 1)
                return false;
        } else if (word != "description" && word != "title" && word != "$schema" &&
                   word != "default") {
            FAIL("the schema uses " << word << ", which this test does not know");
        }
    }
    return true;
}

/// Collects all keys, written like those of project_keys().
void collect_keys(const json& schema, const std::string& path, std::set<std::string>& keys) {
    if (schema.contains("properties"))
        for (const auto& [key, inner] : schema["properties"].items()) {
            const auto here = path.empty() ? key : path + "." + key;
            keys.insert(here);
            collect_keys(inner, here, keys);
        }
    if (schema.contains("items")) collect_keys(schema["items"], path + "[]", keys);
}

/// Calls f(document, at) for `document` with each single value replaced, each key removed, and a
/// key added to each object; `at` names the change.
void mutate(const json& document, const std::function<void(const json&, const std::string&)>& f) {
    const std::vector<json> values{nullptr,
                                   true,
                                   false,
                                   -1,
                                   0,
                                   1,
                                   1.05,
                                   2.5,
                                   1025,
                                   "",
                                   "fault",
                                   "vtp",
                                   "stl",
                                   "vtu",
                                   json::array(),
                                   json::object(),
                                   json::array({1, 2, 3}),
                                   json::array({"vtp"}),
                                   json::array({"msh"}),
                                   json::array({1, 2, 3, 4}),
                                   json{{"a", 1}},
                                   json{{"a", -1}},
                                   json{{"low", json::array({1, 2, 3})}}};
    std::function<void(const json::json_pointer&)> walk = [&](const json::json_pointer& at) {
        const json& here = document.at(at);
        for (const json& value : values) {
            json changed = document;
            changed[at] = value;
            f(changed, at.to_string() + " = " + value.dump());
        }
        if (here.is_object()) {
            json added = document;
            added[at]["surplus"] = 1;
            f(added, at.to_string() + " with surplus");
            for (const auto& [key, unused] : here.items()) {
                json removed = document;
                removed[at].erase(key);
                f(removed, at.to_string() + " without " + key);
                walk(at / key);
            }
        }
        if (here.is_array())
            for (std::size_t i = 0; i < here.size(); ++i) walk(at / i);
    };
    walk(json::json_pointer());
}

} // namespace

TEST_CASE("project: all keys are read", "[io][project]") {
    const auto parsed = parse(full());
    REQUIRE(message_of(parsed) == "no error");
    const Project& p = parsed.value();
    CHECK(p.folder == "/data/run");
    CHECK(p.threads == 2);
    REQUIRE(p.surfaces.size() == 2);
    CHECK(p.surfaces[0].file == "/data/a.ts"); // relative to the project's folder
    CHECK(p.surfaces[0].objects == std::vector<std::string>{"top", "base"});
    CHECK(p.surfaces[0].name.empty());
    CHECK(p.surfaces[0].role == Role::horizon);
    CHECK(p.surfaces[1].file == "/b.ts");
    CHECK(p.surfaces[1].name == "F1");
    CHECK(p.surfaces[1].role == Role::fault);
    CHECK(p.surfaces[1].depth);
    CHECK_FALSE(p.surfaces[0].depth);
    REQUIRE(p.column.size() == 2);
    CHECK(p.column[0].name == "New");
    CHECK(p.column[0].surface == "top");
    CHECK(p.column[0].age == 20.5);
    CHECK(p.column[0].contact == UnitContact::erosive);
    CHECK(p.column[1].surface.empty());
    CHECK_FALSE(p.column[1].age.has_value());
    CHECK(p.column[1].contact == UnitContact::conformable);
    REQUIRE(p.fill.size() == 3);
    CHECK(p.fill[0].surface == "top");
    CHECK(p.fill[0].options.method == FillMethod::rbf);
    CHECK(p.fill[0].options.model == VariogramModel::power);
    CHECK(p.fill[0].options.max_area == 1000.0);
    CHECK(p.fill[0].options.mesh_size == 2.5);
    CHECK(p.fill[0].options.gap_slope == 0.5);
    CHECK(p.fill[0].options.bridge_faults);
    CHECK(p.fill[0].options.smoothing == 0.25);
    CHECK(p.fill[1].options.smoothing == 0.0);
    CHECK_FALSE(p.fill[2].options.smoothing.has_value());
    CHECK(p.fill[1].surface == "base");
    CHECK(p.fill[1].options.method == FillMethod::kriging);
    CHECK_FALSE(p.fill[1].options.model.has_value());
    CHECK(std::isinf(p.fill[1].options.max_area));
    CHECK_FALSE(p.fill[1].options.bridge_faults);
    REQUIRE(p.layers.has_value());
    REQUIRE(p.layers->order.size() == 2);
    CHECK(p.layers->order[0].surface == "top");
    CHECK(p.layers->order[0].hardness == 1.5);
    CHECK(p.layers->order[1].hardness == -2);
    CHECK(p.layers->min_thickness == 0.5);
    const auto* box = std::get_if<ProjectBox>(&p.volume);
    REQUIRE(box != nullptr);
    CHECK(box->low == Point3{0, 0, -1.5});
    CHECK(box->high == Point3{1, 2, 3});
    REQUIRE(p.improve.has_value());
    CHECK(p.improve->options.edge_length == 4.0);
    CHECK(p.max_move == 0.5);
    CHECK(p.improve->options.max_deviation == 0.125);
    CHECK(p.improve->edge_length_of == std::vector<ProjectSize>{{"top", 3}});
    CHECK(p.extend == 100.0);
    CHECK(p.seal == 0.25);
    CHECK(p.seal_of == std::vector<ProjectSize>{{"top", 0}, {"top/base", 3}});
    CHECK(p.tetrahedra.options.edge_length == 2.0);
    CHECK(p.tetrahedra.options.max_volume == 3.5);
    CHECK(p.tetrahedra.options.radius_edge_ratio == 1.4);
    CHECK(p.tetrahedra.size_of == std::vector<ProjectSize>{{"F1", 0.5}, {"top", 1}});
    CHECK(p.tetrahedra.size_in == std::vector<ProjectSize>{{"2", 0.25}, {"top/base", 1}});
    CHECK(p.tetrahedra.split == std::vector<std::string>{"fault", "top"});
    CHECK(p.tetrahedra.outside == true);
    CHECK(p.tetrahedra.options.time_limit == 60);
    CHECK(p.tetrahedra.order == 2);
    CHECK(p.improve->resolution.length == 1.5);
    CHECK(p.improve->resolution.dissolve);
    CHECK(p.tetrahedra.refine_bad == 3);
    CHECK(p.tetrahedra.options.mesher == Mesher::gmsh);
    CHECK_FALSE(p.tetrahedra.options.optimise);
    CHECK_FALSE(p.tetrahedra.move_vertices);
    CHECK(p.outputs.surfaces == std::vector<std::string>{"vtp", "obj"});
    CHECK(p.outputs.tetrahedra == std::vector<std::string>{"vtu", "msh", "msh22"});
    CHECK(p.outputs.blocks == "vtp");
    CHECK_FALSE(p.outputs.certificate);
}

TEST_CASE("project: all kinds of volumes are read", "[io][project]") {
    const auto all = samples();
    const auto rotated = std::get<RotatedBox>(parse(all[1]).value().volume);
    CHECK(rotated.place == Point3{1, 2, 3});
    CHECK_FALSE(rotated.is_corner);
    CHECK(rotated.lengths == std::array<double, 3>{4, 5, 6});
    CHECK(rotated.azimuth == 30);
    CHECK(rotated.plunge == 5);
    CHECK(rotated.roll == -7);
    const auto corner = std::get<RotatedBox>(parse(all[2]).value().volume);
    CHECK(corner.is_corner);
    CHECK(corner.azimuth == 0);
    const auto polygon = std::get<ProjectPolygon>(parse(all[3]).value().volume);
    CHECK(polygon.corners == std::vector<Point2>{{0, 0}, {1, 0}, {0, 1}});
    CHECK(polygon.between == std::array<double, 2>{-5, 0});
    CHECK(std::get<ProjectWithin>(parse(all[4]).value().volume).files ==
          std::vector<std::filesystem::path>{"/data/salt.ts", "/data/lid.ts"});
    const auto least = parse(all[6]).value();
    CHECK(least.volume.index() == 0);
    CHECK_FALSE(least.improve.has_value());
    CHECK(least.folder.empty());
    CHECK(least.tetrahedra.options.time_limit == 600);
    CHECK(least.tetrahedra.options.mesher == Mesher::automatic);
    CHECK(least.tetrahedra.options.optimise);
    CHECK(least.tetrahedra.move_vertices);
    CHECK(least.tetrahedra.refine_bad == 0);
    CHECK_FALSE(least.tetrahedra.outside.has_value());
    CHECK_FALSE(least.surfaces[0].role.has_value());
}

TEST_CASE("project: schema and parser know the same keys", "[io][project]") {
    std::set<std::string> stated;
    collect_keys(schema(), "", stated);
    const auto known = project_keys();
    CHECK(std::vector<std::string>(stated.begin(), stated.end()) == known);
    // Each key occurs in a sample, so that the mutations below reach it.
    std::set<std::string> used;
    const std::function<void(const json&, const std::string&)> walk = [&](const json& value,
                                                                          const std::string& path) {
        if (value.is_array())
            for (const auto& entry : value) walk(entry, path + "[]");
        if (value.is_object())
            for (const auto& [key, inner] : value.items()) {
                used.insert(path.empty() ? key : path + "." + key);
                walk(inner, path.empty() ? key : path + "." + key);
            }
    };
    for (const auto& sample : samples()) walk(sample, "");
    for (const auto& key : known) CHECK(used.contains(key));
}

TEST_CASE("project: schema and parser give the same verdict on every change",
          "[io][project][once]") {
    const json stated = schema();
    std::size_t good = 0, bad = 0;
    for (const auto& sample : samples()) {
        REQUIRE(message(sample) == "no error");
        REQUIRE(holds(stated, sample));
        mutate(sample, [&](const json& changed, const std::string& where) {
            const auto said = message(changed);
            const bool accepted = said == "no error";
            (accepted ? good : bad)++;
            // These rules go beyond the schema: a certificate is about whole surfaces as they were
            // read, about blocks in two formats and tetrahedra of first order; only the lowest unit
            // can be without a base.
            for (const char* beyond : {"p.json: outputs.certificate: must be false with unit",
                                       "p.json: outputs.certificate: is about blocks as",
                                       "p.json: outputs.certificate: is about tetrahedra",
                                       "p.json: column[0].surface: only the lowest unit"})
                if (said.starts_with(beyond)) return;
            INFO(where << ": " << said);
            if (accepted != holds(stated, changed)) CHECK(accepted == holds(stated, changed));
        });
    }
    CHECK(good > 100);
    CHECK(bad > 1000);
}

TEST_CASE("project: what is wrong is named by its key", "[io][project]") {
    const auto with = [](const char* pointer, const json& value) {
        json document = full();
        document[json::json_pointer(pointer)] = value;
        return message(document);
    };
    CHECK(with("/surfaces/1/role", "salt") ==
          "p.json: surfaces[1].role: must be horizon, fault or boundary");
    CHECK(with("/surfaces/1/rolle", "fault") ==
          "p.json: surfaces[1].rolle: unknown key; did you mean role?");
    CHECK(with("/surfaces/0/colour", 1) ==
          "p.json: surfaces[0].colour: unknown key; there are file, objects, name, role or depth");
    CHECK(with("/fill/0/method", "guess") == "p.json: fill[0].method: must be kriging or rbf");
    CHECK(with("/fill/0/smoothing", "much") ==
          "p.json: fill[0].smoothing: must be auto or a number larger than 0");
    CHECK(with("/layers/order/1/hard", 2) ==
          "p.json: layers.order[1].hard: unknown key; there are surface or hardness");
    CHECK(with("/layers/order", json::array()) ==
          "p.json: layers.order: must be a list of at least 1");
    CHECK(with("/tetrahedra/edge-length", 1) ==
          "p.json: tetrahedra.edge-length: unknown key; did you mean edge_length?");
    CHECK(with("/tetrahedra/edge_length", "2") ==
          "p.json: tetrahedra.edge_length: must be a number larger than 0");
    CHECK(with("/tetrahedra/size_of/F1", 0) ==
          "p.json: tetrahedra.size_of.F1: must be a number larger than 0");
    CHECK(with("/tetrahedra/quality", 1) == "p.json: tetrahedra.quality: must be at least 1.1");
    CHECK(with("/improve/layers_in_gaps", 1001) ==
          "p.json: improve.layers_in_gaps: must be at most 1000");
    CHECK(with("/volume_of_interest/box/low", json::array({1, 2})) ==
          "p.json: volume_of_interest.box.low: must be a list of 3");
    CHECK(with("/volume_of_interest/box/low/1", "0") ==
          "p.json: volume_of_interest.box.low[1]: must be a number");
    CHECK(with("/volume_of_interest/within", json::array({"a"})) ==
          "p.json: volume_of_interest: must have one key: box, rotated_box, polygon or within");
    CHECK(with("/outputs/surfaces/0", "dxf")
              .starts_with("p.json: outputs.surfaces[0]: must be vtp, obj, "));
    CHECK(with("/threads", 1.5) == "p.json: threads: must be a whole number, 0 to 1024");
    CHECK(with("/outputs/certificate", true)
              .starts_with("p.json: outputs.certificate: must be false "));
    json document = full();
    document["surfaces"][0].erase("file");
    CHECK(message(document) == "p.json: surfaces[0]: the key file is missing");
    document = full();
    document.erase("surfaces");
    CHECK(message(document) == "p.json: the key surfaces is missing");
}

TEST_CASE("project: a byte of 0 does not end the text", "[io][project]") {
    const std::string good = full().dump();
    REQUIRE(parse_project(good, "/", "p.json"));
    for (const std::string& end : {std::string(1, '\0'), std::string("\0\n{", 3)}) {
        const auto read = parse_project(good + "\n" + end, "/", "p.json");
        REQUIRE_FALSE(read);
        CHECK(read.error().message() == "p.json:2: this is not JSON");
    }
    CHECK_FALSE(parse_project('\0' + good, "/", "p.json"));
}

TEST_CASE("project: any text gives a project or an error", "[io][project]") {
    const auto said = [](std::string_view text) {
        const auto result = parse_project(text, "", "p.json");
        REQUIRE_FALSE(result);
        return result.error().message();
    };
    CHECK(said("") == "p.json:1: this is not JSON");
    CHECK(said("{\n\"format\": \"terrane-project 1\",\n}") == "p.json:3: this is not JSON");
    CHECK(said("[]") == "p.json: must be an object");
    CHECK(said(R"({"threads": 1, "threads": 2})") == "p.json: the key threads is there twice");
    CHECK(said(R"({"threads": 1e999})").starts_with("p.json: "));
    const auto text = full().dump();
    for (std::size_t size = 0; size < text.size(); ++size)
        CHECK(said(text.substr(0, size)) == "p.json:1: this is not JSON");
    const auto missing = read_project("/nowhere/p.json");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == ErrorCode::cannot_open);
}

TEST_CASE("project: formats of tetrahedra hold what is asked for", "[io][project]") {
    const auto said = [](const std::string& tetrahedra, const std::string& outputs) {
        return message_of(parse_project(
            R"({"format": "terrane-project 1", "surfaces": [{"file": "a.ts"}], "tetrahedra": )" +
                tetrahedra + R"(, "outputs": )" + outputs + "}",
            ".", "p.json"));
    };
    CHECK(said(R"({"order": 2})", R"({"tetrahedra": ["vtu", "exo", "ogs"]})") == "no error");
    CHECK_THAT(said(R"({"order": 2})", R"({"tetrahedra": ["vtu", "geos"]})"),
               Catch::Contains("outputs.tetrahedra[1]") && Catch::Contains("second order"));
    CHECK_THAT(said(R"({"order": 3})", R"({"tetrahedra": ["vtu"]})"),
               Catch::Contains("tetrahedra.order") && Catch::Contains("must be 1 or 2"));
    CHECK_THAT(said(R"({"split": ["F"]})", R"({"tetrahedra": ["pylith"]})"),
               Catch::Contains("splits nodes itself"));
    CHECK(said("{}", R"({"tetrahedra": ["pylith"]})") == "no error");
    for (const std::string wanted : {R"({"tetrahedra": ["exo"], "certificate": true})",
                                     R"({"tetrahedra": ["ogs"], "certificate": true})"})
        CHECK_THAT(said("{}", wanted), Catch::Contains("outputs.certificate"));
    CHECK_THAT(said(R"({"order": 2})", R"({"tetrahedra": ["vtu"], "certificate": true})"),
               Catch::Contains("outputs.certificate"));
}
