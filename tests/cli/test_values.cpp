// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Values on points and triangles come along through the commands.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// A floor and a wall; on the floor 1 + x and the vector (1, 2, 3).
const std::string with_values =
    "GOCAD TSurf 1\nHEADER {\nname:floor\n}\nPROPERTIES \"net to gross\" flow\nESIZES 1 3\n"
    "UNITS % m\nTFACE\nPVRTX 1 0 0 0 1 1 2 3\nPVRTX 2 8 0 0 9 1 2 3\nPVRTX 3 0 8 0 1 1 2 3\n"
    "TRGL 1 2 3\nEND\nGOCAD TSurf 1\nHEADER {\nname:wall\n}\nTFACE\nVRTX 1 1 1 -1\nVRTX 2 1 1 1\n"
    "VRTX 3 1 19 0\nTRGL 1 2 3\nEND\n";

/// Returns the number of vertices of a GOCAD file that have these values; others must have none.
std::size_t vertices_with_values(const std::string& text) {
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword;
        std::vector<double> n(8);
        words >> keyword;
        if (keyword != "PVRTX") continue;
        for (double& number : n) words >> number;
        CHECK(std::fabs(n[4] - 1 - n[1]) < 1e-14);
        CHECK((n[5] == 1 && n[6] == 2 && n[7] == 3));
        ++count;
    }
    return count;
}

} // namespace

TEST_CASE("cli: values come along, also through files of other formats", "[cli]") {
    const Folder folder;
    const auto in = folder.input("in.ts", with_values);
    const std::string header = "PROPERTIES \"net to gross\" flow\nNO_DATA_VALUES -99999 -99999\n"
                               "ESIZES 1 3\nUNITS % m\n";
    for (const std::string command : {"convert ", "arrange ", "improve --edge-length 2 "})
        for (const std::string format : {"vtp", "ply", "vtk"}) {
            CAPTURE(command, format);
            const std::string file = "m." + format, option = command == "convert " ? " " : " -o ";
            const auto made = folder.run(command + in + option + file);
            CHECK(made.status == 0);
            CHECK(made.err.empty());
            REQUIRE(folder.run("convert " + file + " back.ts").status == 0);
            const auto back = folder.read("back.ts");
            CHECK(contains(back, "PROPERTIES \"net to gross\" flow\n"));
            CHECK(contains(back, "UNITS % m\n"));
            const std::size_t least = command == "convert " ? 3 : 5;
            CHECK(vertices_with_values(back.substr(0, back.find("END\n"))) >= least);
            REQUIRE(folder.run(command + in + option + "direct.ts").status == 0);
            const auto direct = folder.read("direct.ts");
            CHECK(contains(direct, header));
            CHECK(vertices_with_values(direct) >= least);
        }
}

TEST_CASE("cli: a warning names the values that a format has no place for", "[cli]") {
    const Folder folder;
    const auto in = folder.input("in.ts", with_values);
    const auto made = folder.run("arrange " + in + " -o out.off -o out.ts");
    CHECK(made.status == 0);
    CHECK(contains(made.err,
                   "out.off: the format has no place for these values: net to gross, flow\n"));
    CHECK_FALSE(contains(made.err, "out.ts"));
}

TEST_CASE("cli: files that a certificate is about have no values", "[cli]") {
    const Folder folder;
    const auto in = folder.input("in.ts", with_values);
    const auto made = folder.run("arrange " + in + " -o out.ts -o out.vtp --certificate c.json");
    CHECK(made.status == 0);
    CHECK(contains(made.err, "values on points and triangles are left out of files that a "
                             "certificate is about\n"));
    CHECK(vertices_with_values(folder.read("out.ts")) == 0);
    CHECK(folder.run("verify c.json").status == 0);
}
