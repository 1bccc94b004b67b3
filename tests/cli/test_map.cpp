// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane map`.
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Returns a square from (0, 0) to (100, 100) with heights a x + c.
std::string plane(double a, double c) {
    std::ostringstream text;
    for (const double y : {0.0, 100.0})
        for (const double x : {0.0, 100.0})
            text << "v " << x << " " << y << " " << a * x + c << "\n";
    text << "f 1 2 4 3\n";
    return text.str();
}

/// The numbers of an ESRI grid: those of its header by name, and the rows from north to south.
struct Esri {
    std::map<std::string, double> header;
    std::vector<double> values;
};

Esri esri(const std::string& text) {
    Esri grid;
    std::istringstream in(text);
    for (std::string word; in >> word;) {
        if (std::isalpha(static_cast<unsigned char>(word[0])) == 0) {
            grid.values.push_back(std::stod(word));
            continue;
        }
        for (char& c : word) c = static_cast<char>(std::tolower(c));
        in >> grid.header[word];
    }
    return grid;
}

double missing(const Esri& grid) {
    return grid.header.at("nodata_value");
}

} // namespace

TEST_CASE("map: depth, dip and azimuth of a plane", "[cli][map]") {
    const Folder folder;
    const auto in = folder.input("top.obj", plane(0.5, -1000));
    const auto made = folder.run("map depth " + in + " --step 25 -o depth.asc --stats s.json");
    CHECK(made.err == "");
    REQUIRE(made.status == 0);
    CHECK(contains(made.out,
                   "depth: 5 x 5 nodes, steps of 25, 25 with a value: 950 to 1000, mean 975\n"));
    const auto depth = esri(folder.read("depth.asc"));
    REQUIRE(depth.values.size() == 25);
    for (std::size_t k = 0; k < 25; ++k) CHECK(depth.values[k] == 1000 - 12.5 * double(k % 5));
    const auto statistics = Json::parse(folder.read("s.json"));
    CHECK(statistics["map"]["number"] == "depth");
    CHECK(statistics["map"]["nodes"] == 25);
    CHECK(statistics["map"]["mean"] == 975.0);

    REQUIRE(folder.run("map dip " + in + " --step 25 -o dip.asc").status == 0);
    for (const double value : esri(folder.read("dip.asc")).values)
        CHECK(value == Approx(26.56505117707799)); // atan(1/2)
    REQUIRE(folder.run("map azimuth " + in + " --step 25 -o azimuth.asc").status == 0);
    for (const double value : esri(folder.read("azimuth.asc")).values)
        CHECK(value == 270); // to the west
}

TEST_CASE("map: thickness is vertical, distance is not", "[cli][map]") {
    const Folder folder;
    const auto top = folder.input("top.obj", plane(0.75, 40)),
               base = folder.input("base.obj", plane(0.75, 0));
    const auto thick = folder.run("map thickness " + top + " --to " + base + " --step 10 -o t.asc");
    CHECK(thick.err == "");
    REQUIRE(thick.status == 0);
    for (const double value : esri(folder.read("t.asc")).values) CHECK(value == 40);
    REQUIRE(folder.run("map thickness " + base + " --to " + top + " --step 10 -o t.asc").status ==
            0);
    for (const double value : esri(folder.read("t.asc")).values) CHECK(value == -40);
    // The foot of the perpendicular is 40 * 3/4 * 16/25 = 19.2 to the right, on the plane up to x = 80.
    REQUIRE(folder.run("map distance " + top + " --to " + base + " --step 10 -o d.asc").status ==
            0);
    const auto distance = esri(folder.read("d.asc"));
    REQUIRE(distance.values.size() == 121);
    for (std::size_t k = 0; k < 121; ++k)
        if (k % 11 <= 8) CHECK(distance.values[k] == Approx(32)); // 40 * 4/5
}

TEST_CASE("map: nodes of a grid that is there, and nodes off the surface", "[cli][map]") {
    const Folder folder;
    const auto grid =
        folder.input("nodes.asc", "ncols 3\nnrows 2\nxllcenter 50\nyllcenter 0\ncellsize 50\n"
                                  "NODATA_value -9999\n1 2 3\n4 5 -9999\n");
    const auto in = folder.input("top.obj", plane(1, 0));
    const auto made = folder.run("map height " + in + " --like " + grid + " -o h.asc -o h.irap");
    CHECK(made.err == "");
    REQUIRE(made.status == 0);
    CHECK(contains(made.out,
                   "height: 3 x 2 nodes, steps of 50, 4 with a value: 50 to 100, mean 75\n"));
    const auto height = esri(folder.read("h.asc"));
    const double none = missing(height);
    CHECK(height.values == std::vector<double>{50, 100, none, 50, 100, none});
    CHECK(folder.run("convert h.irap again.obj").status == 0);
    CHECK(contains(folder.read("again.obj"), "v 50 0 50\n"));
}

TEST_CASE("map: where the vertical meets a surface more than once", "[cli][map]") {
    const Folder folder;
    const auto in = folder.input("box.obj", cube);
    const auto made = folder.run("map height " + in + " --step 2 -o h.asc");
    CHECK(made.status == 0);
    CHECK(contains(
        made.err,
        "at 25 nodes the vertical meets the surface more than once: the highest point counts"));
    for (const double value : esri(folder.read("h.asc")).values) CHECK(value == 8);
}

TEST_CASE("map: what cannot be is refused before or after reading, and nothing is written",
          "[cli][map]") {
    const Folder folder;
    const auto in = folder.input("top.obj", plane(1, 0));
    const auto refused = [&](const std::string& arguments, const std::string& reason) {
        const auto outcome = folder.run("map " + arguments);
        INFO(arguments);
        CHECK(outcome.status == 2);
        CHECK(contains(outcome.err, reason));
        CHECK(folder.left().empty());
    };
    refused("depth " + in + " -o d.asc", "give either --step or --like");
    refused("depth " + in + " --step 1 --like " + in + " -o d.asc", "give either --step or --like");
    refused("depth " + in + " --step 10 -o d.vtp",
            "grids are written as .asc, .zmap, .irap, .grd or .vti");
    refused("thickness " + in + " --step 10 -o d.asc", "--to: thickness needs a second surface");
    refused("depth " + in + " --to " + in + " --step 10 -o d.asc", "--to: depth is of one surface");
    refused("weight " + in + " --step 10 -o d.asc", "weight");
    refused("depth " + in + " --step 1e-9 -o d.asc", "more than 10^9 nodes");
    refused("depth " + in + " --like " + in + " -o d.asc", "top.obj");
    refused("depth " + in + " --step 1000 -o h.asc --like missing.asc", "either");
    const auto off =
        folder.run("map height " +
                   folder.input("far.asc", "ncols 2\nnrows 2\nxllcenter 500\nyllcenter 0\n"
                                           "cellsize 5\n1 2\n3 4\n") +
                   " --like in/far.asc --to " + in + " -o h.asc");
    CHECK(off.status == 2);
    const auto empty = folder.run("map height " + in + " --like in/far.asc -o h.asc");
    CHECK(empty.status == 1);
    CHECK(contains(empty.err, "no node has a value: nothing written"));
    CHECK(folder.left().empty());
}

TEST_CASE("map: other units of the second surface are named, and standard input is read once",
          "[cli][map]") {
    const Folder folder;
    const auto in_unit = [&](const std::string& unit) {
        return folder.input(unit + ".ts", "GOCAD TSurf 1\nHEADER {\nname:" + unit +
                                              "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME x\n"
                                              "AXIS_NAME X Y Z\nAXIS_UNIT " +
                                              unit + " " + unit + " " + unit +
                                              "\nZPOSITIVE Elevation\n"
                                              "END_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n"
                                              "VRTX 1 0 0 2\nVRTX 2 4 0 2\nVRTX 3 0 4 2\n"
                                              "TRGL 1 2 3\nEND\n");
    };
    const auto metres = in_unit("m"), feet = in_unit("ft");
    const auto thickness = "map thickness " + metres + " --to " + feet + " --step 1 -o a.asc";
    const auto made = folder.run(thickness);
    CHECK(made.status == 0);
    CHECK(contains(made.err, "the files state different units for x and y: ft (ft) and m (m)"));
    CHECK(folder.run(thickness + " --strict").status == 2);
    const auto converted = folder.run(thickness + " --unit m --strict");
    CHECK(converted.status == 0);
    CHECK(contains(converted.out, "1.3904 m to 1.3904 m"));
    const auto itself =
        folder.run("map thickness " + metres + " --to " + metres + " --step 1 -o a.asc --strict");
    CHECK(itself.err == "");
    CHECK(contains(itself.out, "0 m to 0 m"));
    CHECK(contains(folder.run("map thickness - --to - --format ts --step 1 -o a.asc").err,
                   "standard input can be read only once"));
    const auto by = folder.run("section " + metres + " --by " + feet + " -o a.svg");
    CHECK(contains(by.err, "the files state different units for x and y"));
    for (const std::string number : {"0", "-1", "inf", "some"})
        CHECK(contains(folder.run("map height " + metres + " --step=" + number + " -o a.asc").err,
                       "--step: needs a "));
}
