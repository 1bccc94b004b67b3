// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the volume of interest from outside.
#include <cstddef>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Two horizons and a fault that end inside a box from 0 to 8 on some sides and cross it on others.
const std::string cut_model = level("base", "3") +
                              polygon("top", "-1 -1 5, 6 -1 5, 6 9 5, -1 9 5") +
                              polygon("F1", "4 -1 -1, 4 9 -1, 4 9 9, 4 -1 9") +
                              polygon("elsewhere", "20 0 0, 21 0 0, 20 1 0");

} // namespace

TEST_CASE("cli: all ways to name the same volume of interest give the same blocks", "[cli][once]") {
    const Folder folder;
    const auto in = folder.input("model.obj", cut_model);
    folder.input("cube.obj", cube);
    folder.input("square.txt", "# the licence\n0 0\n8, 0 # metres\n\n8 8 17\n0 8\n");
    int number = 0;
    for (const std::string way :
         {"--box 0,0,0,8,8,8", "--rotated-box 4,4,4,8,8,8,0", "--rotated-box 4,4,4,8,8,8,90,0,180",
          "--rotated-box 0,0,0,8,8,8,0 --corner", "--polygon 0,0,8,0,8,8,0,8 --between 8,0",
          "--polygon in/square.txt --between 0,8", "--within in/cube.obj"}) {
        INFO(way);
        const auto out = "out" + std::to_string(number++);
        const auto r = folder.run("volume " + in + " -o " + out + " --stats s.json " + way);
        INFO(r.err);
        REQUIRE(r.status == 0);
        CHECK(r.err.empty());
        CHECK(contains(r.out, "5 closed blocks, volume 512 in all\n"));
        CHECK(contains(r.out, "1 surface outside\n"));
        CHECK(contains(r.out, "top ends inside: along 8 at (6, 0, 5)\n"));
        const auto json = Json::parse(folder.read(out + "/model.json"));
        REQUIRE(json["blocks"].size() == 6);
        CHECK(json["surfaces"][4]["role"] == "boundary");
        const auto statistics = Json::parse(folder.read("s.json"));
        CHECK(statistics["input"]["surfaces"] == 4);
        const auto& cut = statistics["volume_of_interest"];
        CHECK(cut["surfaces"][0]["area_inside"] == 64);
        CHECK(cut["surfaces"][0]["area_outside"] == 36);
        CHECK(cut["surfaces"][3]["pieces"] == 0);
        REQUIRE(cut["open_borders"].size() == 1);
        CHECK(cut["open_borders"][0]["length"] == 8);
    }
}

TEST_CASE("cli: faces of the boundary have names", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", cut_model);
    REQUIRE(folder.run("volume " + in + " -o out --box 0,0,0,8,8,8 --role base=horizon").status ==
            0);
    const auto json = Json::parse(folder.read("out/model.json"));
    CHECK(json["surfaces"][4]["name"] == "boundary top");
    CHECK(json["surfaces"][6]["name"] == "boundary side 1");
    bool found = false;
    for (const auto& block : json["blocks"])
        found = found || block["name"] == "below base, east of F1";
    CHECK(found);
}

TEST_CASE("cli: arrange in a volume of interest is conforming", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", cut_model);
    const auto r = folder.run("arrange " + in + " -o a.obj --box 0,0,0,8,8,8");
    CHECK(r.status == 0);
    CHECK(folder.run("check a.obj").status == 0);
    // A second cut by the same box changes nothing.
    CHECK(folder.run("arrange a.obj -o b.obj --box 0,0,0,8,8,8").status == 0);
    CHECK(contains(folder.run("volume b.obj -o out").out, "5 closed blocks, volume 512 in all\n"));
}

TEST_CASE("cli: arrange in a volume of interest writes a certificate that verify takes", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", cut_model);
    folder.input("cube.obj", cube);
    for (const auto& [volume, named] :
         {std::pair("--box 0,0,0,8,8,8", "cut by the polygon (0, 0) (8, 0) (8, 8) (0, 8) between 0 "
                                         "and 8: all that is inside, and nothing else"),
          {"--polygon 1,1,7.5,2,2,7.5 --between 7,1",
           "cut by the polygon (1, 1) (7.5, 2) (2, 7.5)"},
          {"--rotated-box 4,4,4,5,4,6,30", "cut by the box with the corners"},
          {"--within in/cube.obj", "cut by the surface of in/cube.obj"}}) {
        INFO(volume);
        REQUIRE(
            folder.run("arrange " + in + " -o out.obj -o out.vtp --certificate c.json " + volume)
                .status == 0);
        const Outcome valid = folder.run("verify c.json");
        INFO(valid.out << valid.err);
        CHECK(valid.status == 0);
        CHECK(contains(valid.out, named));
        CHECK(contains(valid.out, "out.vtp: holds these triangles: every byte"));
    }
}

TEST_CASE("cli: volumes of interest that are none are refused by name", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", cut_model);
    folder.input("open.obj", std::string(cube).substr(0, std::string(cube).rfind("f 4")));
    folder.input("one.txt", "0 0\n1\n");
    const auto refused = [&](const std::string& options, const std::string& reason) {
        for (const std::string& command :
             {"volume " + in + " -o out ", "arrange " + in + " -o a.obj "}) {
            const auto r = folder.run(command + options);
            INFO(options << "\n" << r.err);
            CHECK(r.status == 2);
            CHECK(contains(r.err, reason));
        }
    };
    refused("--box 0,0,0,8,8", "needs six numbers");
    refused("--box 0,0,0,8,8,nan", "");
    refused("--box 0,0,8,8,8,0", "must be below");
    refused("--rotated-box 0,0,0,8,8,8", "needs seven or nine numbers");
    refused("--rotated-box 0,0,0,8,-8,8,0", "must be positive");
    refused("--corner", "needs --rotated-box");
    refused("--polygon 0,0,8,0,8,8", "each needs the other one");
    refused("--between 0,8", "each needs the other one");
    refused("--polygon 0,0,8,0,8 --between 0,8", "pairs of numbers");
    refused("--polygon 0,0,8,8,8,0,0,8 --between 0,8", "edge 1 from (0, 0) to (8, 8) and edge 3");
    refused("--polygon nowhere.txt --between 0,8", "nowhere.txt");
    refused("--polygon in/one.txt --between 0,8", "one.txt:2");
    refused("--within in/open.obj", "not closed");
    refused("--within nowhere.obj", "nowhere.obj");
    refused("--box 0,0,0,8,8,8 --within in/open.obj", "only one");
    CHECK(folder.left().empty());
}

#ifdef TERRANE_HAS_TETGEN
TEST_CASE("cli: tetrahedra only inside the volume of interest", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", cut_model);
    const auto r = folder.run("tetrahedralize " + in +
                              " -o a.msh --msh 2.2 -o a.vtu --box 0,0,0,8,8,8 --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, ", 5 blocks\n"));
    CHECK_FALSE(contains(r.out, "  block 0 "));
    const auto json = Json::parse(folder.read("s.json"))["tetrahedra"];
    CHECK(json["check"]["violations"].empty());
    // The tetrahedra of the file, element type 4, fill the box exactly: no block is the outside.
    std::string line;
    std::size_t tetrahedra = 0;
    std::istringstream file(folder.read("a.msh"));
    while (std::getline(file, line)) {
        std::istringstream words(line);
        int id = 0, type = 0, tags = 0, physical = 0, rest = 0, count = 4;
        if (!(words >> id >> type >> tags >> physical) || type != 4 || tags != 2) continue;
        while (words >> rest) ++count;
        if (count != 9) continue;
        ++tetrahedra;
        CHECK(physical != 0);
    }
    CHECK(tetrahedra == json["tetrahedra"].get<std::size_t>());
}
#endif

TEST_CASE("cli: a polygon of GeoJSON", "[cli]") {
    const Folder folder;
    folder.input("top.obj", "v -1 -1 5\nv 9 -1 5\nv 9 9 5\nv -1 9 5\nf 1 2 3 4\n");
    const std::string ring = "[[0, 0], [8, 0], [8, 8], [0, 8], [0, 0]]";
    folder.input("licence.geojson",
                 R"({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [)" + ring +
                     "]}}");
    const auto made =
        folder.run("volume in/top.obj -o out --polygon in/licence.geojson --between 0,8");
    INFO(made.err);
    CHECK(made.status == 0);
    CHECK(contains(made.out, "2 closed blocks, volume 512 in all"));
    folder.input("two.json",
                 R"({"type": "MultiPolygon", "coordinates": [[)" + ring + "], [" + ring + "]]}");
    const auto two = folder.run("volume in/top.obj -o two --polygon in/two.json --between 0,8");
    CHECK(two.status == 2);
    CHECK(contains(two.err, "in/two.json: coordinates[1]: this is a second polygon"));
}

TEST_CASE("cli: a shapefile of lines is no outline", "[cli]") {
    const Folder folder;
    folder.input("top.obj", "v -1 -1 5\nv 9 -1 5\nv 9 9 5\nv -1 9 5\nf 1 2 3 4\n");
    const auto lines = folder.run(
        "volume in/top.obj -o out --polygon $D/loopstructural/fault_trace.shp --between 0,8");
    CHECK(lines.status == 2);
    CHECK((contains(lines.err, "fault_trace.shp: the file has lines; an outline is a polygon") ||
           contains(lines.err, "fault_trace.shp: this build cannot read shapefiles")));
    CHECK(folder.left().empty());
}
