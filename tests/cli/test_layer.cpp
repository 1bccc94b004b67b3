// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane layer` from outside.
#include <algorithm>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Shale rises from -4 to 4, with a crease at x = 4.
const std::string tilted = polygon("shale", "0 0 -4, 8 0 4, 8 8 4, 0 8 -4");

const std::string flat = polygon("salt", "0 0 0, 8 0 0, 8 8 0, 0 8 0");

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
}

} // namespace

TEST_CASE("cli: layer replaces the soft horizon beyond the hard one", "[cli][layer]") {
    const Folder folder;
    const auto soft = folder.input("shale.obj", tilted), hard = folder.input("salt.obj", flat);
    for (const std::string keep : {"upper", "lower"}) {
        const auto run = folder.run("layer --hard " + hard + " --soft " + soft + " --keep " + keep +
                                    " -o " + keep + ".obj --stats " + keep + ".json");
        INFO(run.err);
        REQUIRE(run.status == 0);
        CHECK(run.out.find("salt: nothing to replace") != std::string::npos);
        CHECK(run.out.find("shale: ") != std::string::npos);
        CHECK(run.out.find("wrote " + keep + ".obj") != std::string::npos);
        const auto mesh = folder.read(keep + ".obj");
        CHECK(count(mesh, "\ng ") >= 3); // groups of both, of one, of the other
        CHECK(mesh.find(keep == "upper" ? "\nv 8 0 4" : "\nv 0 0 -4") != std::string::npos);
        CHECK(mesh.find(keep == "upper" ? "\nv 0 0 -4" : "\nv 8 0 4") == std::string::npos);
        CHECK(folder.run("check " + keep + ".obj").status == 0);
        const auto json = Json::parse(folder.read(keep + ".json"));
        const auto& listed = json["layers"];
        REQUIRE(listed.size() == 2);
        const auto& report = listed[0]["name"] == "shale" ? listed[0] : listed[1];
        CHECK(report["parts"] == 1);
        CHECK(report["taken_area"].get<double>() == Approx(32));
        CHECK(report["largest_move"].get<double>() == Approx(4));
    }
}

TEST_CASE("cli: layer of a stack in one file, with a thickness", "[cli][layer]") {
    const Folder folder;
    const auto both = folder.input("both.obj", tilted + flat);
    const auto run = folder.run("layer " + both +
                                " --layer shale=1 --layer salt=2.5 "
                                "--min-thickness 0.5 -o out.ts");
    INFO(run.err);
    REQUIRE(run.status == 0);
    const auto written = folder.read("out.ts");
    CHECK(written.find(" 0.5") != std::string::npos);
    CHECK(folder.run("check out.ts").status == 0);
    // Read back, the stack needs no change: shale already lies above salt.
    const auto again = folder.run("layer out.ts --layer shale=1 --layer salt=2.5 -o again.obj");
    CHECK(again.status == 0);
    CHECK(count(again.out, "nothing to replace") == 2);
}

TEST_CASE("cli: layer writes a certificate that verify takes", "[cli][layer]") {
    const Folder folder;
    const auto soft = folder.input("shale.obj", tilted), hard = folder.input("salt.obj", flat);
    const auto run = folder.run("layer --hard " + hard + " --soft " + soft +
                                " --keep upper -o out.obj -o out.vtp --certificate c.json");
    INFO(run.err);
    REQUIRE(run.status == 0);
    const auto valid = folder.run("verify c.json");
    INFO(valid.out << valid.err);
    CHECK(valid.status == 0);
    CHECK(valid.out.find("2 layers, from the top down: shale (hardness 0), salt (hardness 1)") !=
          std::string::npos);
    CHECK(valid.out.find("out.vtp: holds these triangles: every byte") != std::string::npos);
    CHECK(folder.run("verify c.json --output " + soft).status == 1);
    CHECK(folder.run("verify c.json --max-deviation 0").status == 1);
    const auto thick =
        folder.run("layer " + soft + " " + hard + " --layer shale=1 --layer salt=2 " +
                   "--min-thickness 1 -o thick.obj --certificate thick.json");
    INFO(thick.err);
    REQUIRE(thick.status == 0);
    const auto shown = folder.run("verify thick.json");
    INFO(shown.out << shown.err);
    CHECK(shown.status == 0);
    CHECK(shown.out.find("moved by multiples of the thickness 1; that they keep it") !=
          std::string::npos);
    CHECK(folder.run("verify thick.json --max-deviation 0").status == 1);
    CHECK(folder
              .run("layer --hard " + hard + " --soft " + soft +
                   " --keep upper -o no.obj --certificate -")
              .status == 2);
}

TEST_CASE("cli: layer says what is wrong with its options", "[cli][layer]") {
    const Folder folder;
    const auto soft = folder.input("shale.obj", tilted), hard = folder.input("salt.obj", flat);
    const auto wall = folder.input("wall.obj", "o wall\nv 1 1 0\nv 2 1 0\nv 2 1 3\nf 1 2 3\n");
    for (const std::string& wrong :
         {std::string("layer -o x.obj"), "layer --hard " + hard + " -o x.obj",
          "layer --hard " + hard + " --soft " + soft + " -o x.obj",
          "layer --hard " + hard + " --soft " + soft + " --keep both -o x.obj",
          "layer " + soft + " --keep upper --layer shale=1 -o x.obj",
          "layer " + soft + " --layer shale -o x.obj",
          "layer " + soft + " --layer shale=hard -o x.obj",
          "layer " + soft + " --layer none=1 -o x.obj",
          "layer " + soft + " --layer shale=1 --layer shale=2 -o x.obj",
          "layer " + soft + " " + hard +
              " --layer shale=1 --layer salt=2 --min-thickness -3 -o x.obj",
          "layer " + soft + " " + wall + " --layer shale=1 --layer wall=2 -o x.obj"}) {
        const auto run = folder.run(wrong);
        CAPTURE(wrong, run.err);
        CHECK(run.status == 2);
        CHECK(!run.err.empty());
        CHECK(folder.left().empty());
    }
}
