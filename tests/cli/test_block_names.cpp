// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names of blocks in all files, from outside.
#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "boxed_project.hpp"
#include "program.hpp"

using namespace program_test;

namespace {

const std::string two_layers = base_and_top + polygon("F1", "3 -1 -1, 3 9 -1, 3 9 9, 3 -1 9");

constexpr auto column_text = R"({"column": [
    {"unit": "Cover \"A\"", "surface": "top", "age": 10},
    {"unit": "Reservoir", "surface": "base", "age": 60, "contact": "erosive"},
    {"unit": "Basement"}]})";

const std::string layers_in_box = " --box 0,0,0,8,8,8 --role base=horizon --role top=horizon"
                                  " --role F1=fault ";

std::vector<std::string> block_names_in(const Json& model) {
    std::vector<std::string> names;
    for (const auto& block : model["blocks"]) names.push_back(block["name"]);
    return names;
}

} // namespace

TEST_CASE("cli: a column names blocks in every file of volume", "[cli][names]") {
    const Folder folder;
    const auto in = folder.input("layers.obj", two_layers);
    const auto units = folder.input("column.json", column_text);
    const auto r = folder.run("volume " + in + layers_in_box + "-o out --column " + units +
                              " --juxtaposition j.csv --certificate c.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "  Reservoir, west of F1\n"));
    const auto json = Json::parse(folder.read("out/model.json"));
    const auto names = block_names_in(json);
    CHECK(std::count(names.begin(), names.end(), "Cover \"A\", east of F1") == 1);
    for (const auto& block : json["blocks"])
        if (block["name"] == "Reservoir, west of F1") {
            CHECK(block["unit"] == "Reservoir");
            CHECK(block["age"] == 60);
        }
    CHECK(contains(folder.read("j.csv"), "\"Cover \"\"A\"\", west of F1\""));
    const auto vtm = folder.read("out/model.vtm");
    CHECK(contains(vtm, "name=\"Cover &quot;A&quot;, west of F1\" file=\"blocks/block_"));
    CHECK(contains(vtm, "name=\"F1 between Reservoir, west of F1 and Reservoir, east of F1\""));
    CHECK(contains(folder.read("out/result.vtp"), "Name=\"block_name\" NumberOfTuples=\"7\""));
    CHECK(contains(folder.read("out/blocks/block_1.vtp"),
                   "Name=\"block_name\" NumberOfTuples=\"1\""));
    CHECK(folder.run("verify c.json").status == 0);
    CHECK(folder.run("check out/result.vtp").status == 0);
}

TEST_CASE("cli: a column that does not fit is refused before the work", "[cli][names]") {
    const Folder folder;
    const auto in = folder.input("layers.obj", two_layers);
    const auto refused = [&](const std::string& text, const std::string& reason) {
        const auto units = folder.input("column.json", text);
        for (const std::string command : {"volume ", "tetrahedralize "}) {
            const auto r =
                folder.run(command + in + layers_in_box + "-o out.vtu --column " + units);
            INFO(r.err);
            CHECK(r.status == 2);
            CHECK(contains(r.err, reason));
        }
        CHECK(folder.left().empty());
    };
    refused(R"({"column": [{"unit": "A", "surface": "tpo"}]})",
            "column.json: column[0].surface: no surface is called tpo; did you mean top?");
    refused(R"({"column": [{"unit": "A"}, {"unit": "B"}]})",
            "column[0].surface: only the lowest unit can be without a base");
    refused(R"({"column": [{"unit": "A", "contact": "faulted"}]})", "column[0].contact");
    refused(R"({"column": []})", "column");
    refused(R"({"units": []})", "units");
    refused("[", "column.json:1");
}

TEST_CASE("cli: a GOCAD model names blocks by its regions and layers", "[cli][names]") {
    const Folder folder;
    REQUIRE(folder.run("volume $D/ringmesh/split_cube.ml -o out").status == 0);
    const auto json = Json::parse(folder.read("out/model.json"));
    auto names = block_names_in(json);
    std::sort(names.begin(), names.end());
    CHECK(names == std::vector<std::string>{"Bottom", "Top", "outside"});
    for (const auto& block : json["blocks"]) // the upper half has less depth
        if (block["name"] == "Top") CHECK(double(block["volume"]) == Approx(0.3));
    // Another surface divides the regions.
    const auto in = folder.input("wall.obj", "o W\nv .4 -1 -2\nv .4 2 -2\nv .4 2 1\nv .4 -1 1\n"
                                             "f 1 2 3 4\n");
    REQUIRE(folder.run("volume " + in + " $D/ringmesh/split_cube.ml -o cut").status == 0);
    names = block_names_in(Json::parse(folder.read("cut/model.json")));
    std::sort(names.begin(), names.end());
    CHECK(names == std::vector<std::string>{"Bottom, east of W", "Bottom, west of W",
                                            "Top, east of W", "Top, west of W", "outside"});
}

TEST_CASE("cli: all blocks of a larger GOCAD model get the names of its regions", "[cli][names]") {
    const Folder folder;
    REQUIRE(folder.run("volume $D/ringmesh/modelA2.ml -o out").status == 0);
    for (const auto& name : block_names_in(Json::parse(folder.read("out/model.json"))))
        CHECK((name == "outside" || name.find("Region_") != std::string::npos));
}

TEST_CASE("cli: blocks and interfaces in every format of surfaces", "[cli][names]") {
    const Folder folder;
    const auto in = folder.input("layers.obj", two_layers);
    for (const std::string format : {"vtp", "obj", "ts", "ply", "off", "stl", "msh", "msh22", "inp",
                                     "mesh", "poly", "smesh"}) {
        INFO(format);
        const auto out = "out_" + format;
        REQUIRE(folder.run("volume " + in + layers_in_box + "-o " + out + " --parts " + format)
                    .status == 0);
        const auto json = Json::parse(folder.read(out + "/model.json"));
        CHECK(json["blocks"].size() == 7);
        const std::string file = json["blocks"][1]["file"];
        CHECK(file == "blocks/block_1." + (format == "msh22" ? std::string("msh") : format));
        CHECK_FALSE(folder.read(out + "/" + file).empty());
        if (format != "inp" && format != "mesh" && format != "poly" && format != "smesh")
            CHECK(folder.run("check " + out + "/" + file).status == 0);
    }
    const auto r =
        folder.run("volume " + in + layers_in_box + "-o c --parts ply --certificate c.json");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "--certificate: is about parts as vtp or obj only"));
}

TEST_CASE("cli: volumes, areas and lengths have the unit that the files state", "[cli][names]") {
    const Folder folder;
    const auto in = folder.input("layers.obj", two_layers);
    REQUIRE(folder.run("convert " + in + " all.ts").status == 0);
    const auto with_unit = [&](const std::string& unit) {
        const auto edit = "sed 's/^ZPOSITIVE/AXIS_UNIT \"" + unit + "\" \"" + unit + "\" \"" +
                          unit + "\"\\n&/' all.ts > unit.ts";
        REQUIRE(folder.shell(edit).status == 0);
        const auto r = folder.run("volume unit.ts -o " + unit + layers_in_box);
        CHECK(r.status == 0);
        return r.out;
    };
    CHECK(contains(with_unit("m"), "6 closed blocks, volume 512 m3 in all\n"));
    const auto feet = with_unit("ft");
    CHECK(contains(feet, "volume 512 ft3 in all\n"));
    CHECK(contains(feet, "areas of the regions, ft2\n"));
    CHECK(contains(folder.run("volume " + in + " -o none" + layers_in_box).out,
                   "volume 512 in all\n"));
}

TEST_CASE("cli: improve states units, and a project converts to its own", "[cli][names]") {
    const Folder folder;
    const auto in = folder.input("layers.obj", two_layers);
    REQUIRE(folder.run("convert " + in + " all.ts").status == 0);
    REQUIRE(folder.shell("sed 's/^ZPOSITIVE/AXIS_UNIT \"km\" \"km\" \"km\"\\n&/' all.ts > in/km.ts")
                .status == 0);
    const auto improved =
        folder.run("improve in/km.ts -o km.vtp --edge-length 2 --box 0,0,0,8,8,8").out;
    CHECK(contains(improved, "edges min, mean, max, km\n"));
    CHECK(contains(improved, "volumes: 6 blocks, 512 km3 before, 512 km3 after"));
    CHECK(contains(improved, " is shown to be within 0.1 km of what it was, measured "));
    auto json = Json::parse(R"({"format": "terrane-project 1", "unit": "m",
        "surfaces": [{"file": "km.ts"}],
        "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8000, 8000, 8000]}},
        "improve": {"edge_length": 2000}, "outputs": {"surfaces": ["obj"], "blocks": "obj"}})");
    const auto r = folder.run("build " + folder.input("p.json", json.dump()) + " -o out");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "6 closed blocks, volume 512 km3 in all\n"));
    CHECK(contains(r.out, " is shown to be within 100 m of what it was"));
    CHECK(Json::parse(folder.read("out/model/model.json"))["blocks"].size() == 7);
    json["unit"] = "yard";
    const auto wrong = folder.run("build " + folder.input("p.json", json.dump()) + " -o out2");
    CHECK(wrong.status == 2);
    CHECK(contains(wrong.err, "in/p.json: unit: "));
}

TEST_CASE("cli: volume lists the leaks that separate blocks before the others", "[cli][names]") {
    const Folder folder;
    const auto r = folder.run("volume $D/../../docs/data/top.ts $D/../../docs/data/base.ts "
                              "$D/../../docs/data/fault.ts -o out --box 0,0,-1700,2000,1500,-700");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "closed blocks, volume 3 km3 in all\n"));
    const auto at = r.out.find("leaks: closing gaps of up to 20 m separates blocks where\n"
                               "  top ends by fault: along ");
    REQUIRE(at != std::string::npos);
    CHECK(contains(r.out.substr(at), "\nharmless: "));
    const auto json = Json::parse(folder.read("out/model.json"));
    std::size_t separating = 0;
    for (const auto& leak : json["leaks"])
        if (leak.value("separates", false)) ++separating;
    CHECK(separating == 1);
}

#ifdef TERRANE_HAS_TETGEN
TEST_CASE("cli: build names blocks and tetrahedra by the column of the project", "[cli][names]") {
    const Folder folder;
    folder.input("layers.obj", two_layers);
    auto project = Json::parse(R"({"format": "terrane-project 1", "folder": "run",
        "surfaces": [{"file": "layers.obj", "objects": ["base", "top"], "role": "horizon"},
                     {"file": "layers.obj", "objects": ["F1"], "role": "fault"}],
        "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}},
        "tetrahedra": {"size_in": {"Reservoir, west of F1": 1}},
        "outputs": {"blocks": "vtp", "tetrahedra": ["vtu", "msh"]}})");
    project["column"] = Json::parse(column_text)["column"];
    const auto file = folder.input("project.json", project.dump());
    const auto r = folder.run("build " + file + " -o run");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "  Basement, east of F1\n"));
    CHECK(contains(folder.read("run/tetrahedra.msh"), ": Reservoir, west of F1\""));
    CHECK(contains(folder.read("run/tetrahedra.vtu"), "type=\"UInt8\" Name=\"block_name\""));
    CHECK(contains(folder.read("run/model/model.vtm"), "name=\"Reservoir, west of F1\""));
    project["column"][1]["surface"] = "bottom";
    const auto wrong =
        folder.run("build " + folder.input("project.json", project.dump()) + " -o other");
    CHECK(wrong.status == 2);
    CHECK(contains(wrong.err, "project.json: column[1].surface: no surface is called bottom"));
}
#endif
