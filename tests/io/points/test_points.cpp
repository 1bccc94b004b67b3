// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cctype>
#include <string>

#include <terrane/io/files.hpp>

#include "support/paths.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

std::vector<Surface> read(std::string_view text, Format format = Format::xyz,
                          const ReadOptions& options = {}) {
    auto surfaces = parse_surfaces(text, "a", format, options);
    REQUIRE(message_of(surfaces) == "no error");
    return std::move(surfaces).value();
}

bool lower_is(std::string text, std::string_view lower) {
    for (char& c : text) c = static_cast<char>(std::tolower(c));
    return text == lower;
}

const std::vector<Point3> corner{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}};

} // namespace

TEST_CASE("points: columns by position, by name, behind names of surfaces", "[io][points]") {
    for (const auto* text :
         {"0 0 1\n1 0 2\n0 1 3\n", "\r\n0,0,1\r\n1,0,2,77\r\n0,1,3\r\n", "0;0;1\n1;0;2\n0;1;3",
          "x y z\n0 0 1\n1 0 2\n0 1 3\n", "# made by\nid;Z;Y;X\n9;1;0;0\n9;2;0;1\n9;3;1;0\n",
          "Horizon of a grid\n  0 0 1\n1 0 2\n0 1 3\nEOD\nnot read\n",
          "# inline crossline z\n0 0 1\n1 0 2\n0 1 3\n",
          "@line\n#more\n1331.0 2009 0 0 1\n1 2 1 0 2\n1 2 0 1 3\nEOB",
          "0 0 1\n1 0 2\n0 1 3\n999.000000 999.000000 999.000000\n5 5 1e30\n6 6 -999.25\n"}) {
        INFO(text);
        const auto surfaces = read(text);
        REQUIRE(surfaces.size() == 1);
        CHECK(surfaces[0].name == "a");
        CHECK(surfaces[0].vertices == corner);
        CHECK(surfaces[0].triangles == std::vector<Triangle>{{0, 1, 2}});
    }
    const auto two = read("# \"X\" \"Y\" \"Z\"\n\"top\" 0 0 1\n\"base\" 0 0 0\n\"top\" 1 0 2\n"
                          "\"top\" 0 1 3\n\"base\" 1 0 0\n\"base\" 0 1 0\n");
    REQUIRE(two.size() == 2);
    CHECK(two[0].name == "top");
    CHECK(two[0].vertices == corner);
    CHECK(two[1].name == "base");
    CHECK(two[1].triangles.size() == 1);
}

TEST_CASE("points: a column of names gives a surface for each", "[io][points]") {
    const std::string rows = "0,0,1,top\n1,0,2,top\n0,1,3,top\n0,0,0,F1\n1,0,0,F1\n0,1,0,F1\n";
    for (const auto* column : {"formation", "Horizon", "SURFACE", "fault", "unit", "name"}) {
        INFO(column);
        const auto two = read("x,y,z," + std::string(column) + "\n" + rows);
        REQUIRE(two.size() == 2);
        CHECK(two[0].name == "top");
        CHECK(two[0].vertices == corner);
        CHECK(two[1].name == "F1");
        CHECK(two[0].role == (lower_is(column, "horizon") ? Role::horizon
                              : lower_is(column, "fault") ? Role::fault
                                                          : Role::unknown));
    }
    // Names first, cells in quotes, empty cells, other numbers, and a point without a height.
    const auto quoted = read("formation;id;X;Y;Z\n\"upper top\";7;0;0;1\n\"upper top\";;1;0;2\n"
                             "\"upper top\";9;5;5;\n\"upper top\";9;0;1;3\n");
    REQUIRE(quoted.size() == 1);
    CHECK(quoted[0].name == "upper top");
    CHECK(quoted[0].vertices == corner);
    // Without names in some rows these rows are a surface of their own, called as the file.
    const auto nameless = read("x,y,z,name\n0,0,1,\n1,0,2,\n0,1,3,\n");
    REQUIRE(nameless.size() == 1);
    CHECK(nameless[0].name == "a");
}

TEST_CASE("points: units and depths that a heading states", "[io][points]") {
    const std::string rows = "0,0,1\n1,0,2\n0,1,3\n";
    const auto frame = [&](const std::string& heading) {
        return read(heading + "\n" + rows)[0].frame;
    };
    CHECK(frame("x,y,z").vertical_unit.empty());
    CHECK(frame("x,y,Depth_ft").vertical_unit == "ft");
    CHECK(frame("x,y,Depth_ft").column_of_depths);
    CHECK(frame("x,y,z (m)").vertical_unit == "m");
    CHECK(frame("x [m],y [m],elevation[US-ft]").horizontal_unit == "m");
    CHECK(frame("x [m],y [m],elevation[US-ft]").vertical_unit == "ftUS");
    CHECK(frame("x [m],y [ft],z").horizontal_unit.empty());
    CHECK_FALSE(frame("x,y,elevation").column_of_depths);
    const auto blanks = read("# x (m) y (m) z (ft)\n0 0 1\n1 0 2\n0 1 3\n");
    CHECK(blanks[0].vertices == corner);
    CHECK(blanks[0].frame.vertical_unit == "ft");
    const auto down = read("x,y,depth\n" + rows, Format::xyz, {.depth = true});
    CHECK(down[0].frame.vertical_axis == VerticalAxis::down);
    CHECK_FALSE(down[0].frame.column_of_depths);
    const auto metres = read("x_m,y_m,depth_ft\n" + rows, Format::xyz, {.unit = "m"});
    CHECK(metres[0].vertices[1] == Point3{1, 0, 2 * 0.3048});
    CHECK(metres[0].frame.vertical_unit == "m");
}

TEST_CASE("points: depth, the longest edge, and the first of those at one place", "[io][points]") {
    const auto down = read("0 0 1\n9 0 0\n0 9 3\n0 0 5\n", Format::xyz, {.depth = true});
    CHECK(down[0].vertices == std::vector<Point3>{{0, 0, -1}, {9, 0, 0}, {0, 9, -3}, {0, 0, -5}});
    CHECK(down[0].triangles == std::vector<Triangle>{{0, 1, 2}});
    const std::string far = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 0\n9 1 0\n";
    CHECK(read(far, Format::xyz, {.max_edge = 2})[0].triangles.size() == 2);
    CHECK(read(far, Format::xyz, {.max_edge = 20})[0].triangles.size() == 4);
}

TEST_CASE("points: GOCAD's VSet by object, PLine all together", "[io][points]") {
    const auto vset = read("GOCAD VSet 1\nHEADER {\nname:top\n}\nZPOSITIVE Depth\nVRTX 1 0 0 -1\n"
                           "PVRTX 2 1 0 -2 7.5\nVRTX 3 0 1 -3\nATOM 4 1\nEND\nGOCAD TSurf 1\nEND\n"
                           "GOCAD VSet 1\nVRTX 1 0 0 1\nVRTX 2 1 0 2\nVRTX 3 0 1 3\nEND\n",
                           Format::vset);
    REQUIRE(vset.size() == 2);
    CHECK(vset[0].name == "top");
    CHECK(vset[0].vertices == corner);
    CHECK(vset[1].name == "a");
    CHECK(vset[1].vertices == corner);
    const auto lines = read("GOCAD PLine 1\nHEADER {\nname: s\n}\nILINE\nVRTX 1 0 0 1\nVRTX 2 1 0 "
                            "2\nSEG 1 2\nEND\nGOCAD PLine 1\nVRTX 1 0 1 3\nEND\n",
                            Format::vset);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].name == "s");
    CHECK(lines[0].vertices == corner);
}

TEST_CASE("points: broken files", "[io][points]") {
    const auto message = [](std::string_view text, Format format = Format::xyz) {
        return message_of(parse_surfaces(text, "a", format));
    };
    CHECK(message("") == "a: there is no point");
    CHECK(message("# nothing\nwords only\n") == "a: there is no point");
    CHECK(message("0 0 1\n1 0\n") == "a:2: a point needs 3 numbers");
    CHECK(message("0 0 1\n1 0 x\n") == "a:2: \"x\" is not a number");
    CHECK(message("0 0 nan\n") == "a:1: \"nan\" is not a finite number");
    CHECK(message("0 0 1\nhello\n") == "a:2: a point needs 3 numbers");
    CHECK(message("0 0 0\n1 1 1\n2 2 2\n") ==
          "a: no three of the points are near enough to make a triangle");
    CHECK(message("0 0 0\n1e301 0 0\n0 1e301 0\n").find("beyond 1e300") != std::string::npos);
    CHECK(message("hello\n", Format::vset) == "a: not a GOCAD file: no line begins with GOCAD");
    CHECK(message("GOCAD TSurf 1\nEND\n", Format::vset) == "a: there is no VSet and no PLine");
    CHECK(message("GOCAD VSet 1\nVRTX 1 0 0 0\n", Format::vset) ==
          "a:2: the object that begins in line 1 has no END");
    CHECK(message("GOCAD VSet 1\nVRTX x 0 0 0\n", Format::vset) == "a:2: VRTX needs an id");
    CHECK(message("GOCAD VSet 1\nZPOSITIVE up\n", Format::vset).find("Elevation or Depth") !=
          std::string::npos);
}

TEST_CASE("points: horizons of real surveys", "[io][points]") {
    const std::string data = test_data() + "/gio/";
    const auto f3 = read_surfaces(data + "F3_FS6_ILXL.dat", std::nullopt, {.depth = true});
    REQUIRE(message_of(f3) == "no error");
    REQUIRE(f3.value().size() == 1);
    const Surface& s = f3.value()[0];
    CHECK(s.name == "F3_Demo_2_FS6");
    CHECK(s.vertices.size() == 3019);
    CHECK(s.vertices[0] == Point3{110, 1042, -865.397810935974121});
    // The points form a lattice of spacing 2, so that each triangle is half of a cell.
    for (const Triangle& t : s.triangles) {
        const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
        CHECK((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 4);
    }
    const auto nimitz = read_surfaces(data + "Nimitz_Salmon_XY-and-ILXL_Single-line-header.dat");
    REQUIRE(message_of(nimitz) == "no error");
    CHECK(nimitz.value()[0].vertices.size() == 1830);
    CHECK(nimitz.value()[0].vertices[0] == Point3{1709752.38, 5828111.45, 531.371772289276123});
}
