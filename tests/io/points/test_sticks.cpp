// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>

#include "support/paths.hpp"

using namespace terrane;
using namespace test_support;

namespace {

std::vector<Surface> read_them(const std::string& text, const ReadOptions& options = {}) {
    auto read = parse_surfaces(text, "a.sticks", Format::sticks, options);
    if (!read) FAIL(read.error().message());
    return std::move(read).value();
}

std::string message_of_sticks(const std::string& text) {
    const auto read = parse_surfaces(text, "a", Format::sticks);
    REQUIRE_FALSE(read);
    return read.error().message();
}

const std::string two = "0 0 -1 1\n0 0 -3 1\n5 0 -1 2\n5 0 -3 2\n";

} // namespace

TEST_CASE("fault sticks: triangles between successive sticks", "[io][sticks]") {
    const auto faults = read_them(two + "9 0 -2 3\n");
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].name == "a");
    CHECK(faults[0].role == Role::fault);
    CHECK(faults[0].vertices ==
          std::vector<Point3>{{0, 0, -1}, {0, 0, -3}, {5, 0, -1}, {5, 0, -3}, {9, 0, -2}});
    CHECK(faults[0].triangles == std::vector<Triangle>{{0, 2, 1}, {1, 2, 3}, {2, 4, 3}});
}

TEST_CASE("fault sticks: points are joined by their shares of the length", "[io][sticks]") {
    // The first stick has points at 0, 1/4 and 1 of its length, the second at 0, 1/2 and 1.
    const auto fault = read_them("0 0 0 1\n0 0 -1 1\n0 0 -4 1\n5 0 0 2\n5 0 -3 2\n5 0 -6 2\n")[0];
    CHECK(fault.triangles == std::vector<Triangle>{{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}});
}

TEST_CASE("fault sticks: a stick that was drawn upward is turned round", "[io][sticks]") {
    const auto fault = read_them("0 0 -1 1\n0 0 -3 1\n5 0 -3 2\n5 0 -1 2\n9 0 -3 3\n9 0 -1 3\n")[0];
    CHECK(fault.triangles == std::vector<Triangle>{{0, 3, 1}, {1, 3, 2}, {3, 5, 2}, {2, 5, 4}});
}

TEST_CASE("fault sticks: the forms of a line", "[io][sticks]") {
    const auto expected = read_them(two);
    const auto same = [&](const std::string& text, const std::string& name) {
        INFO(text);
        const auto faults = read_them(text);
        REQUIRE(faults.size() == 1);
        CHECK(faults[0].name == name);
        CHECK(faults[0].vertices == expected[0].vertices);
        CHECK(faults[0].triangles == expected[0].triangles);
    };
    same("INLINE-  784  604  0 0 -1 F 7 north 1\nINLINE-  784  604  0 0 -3 F 7 north 1\n"
         "XLINE-  784  604  5 0 -1 F 7 north 2\nXLINE-  784  604  5 0 -3 F 7 north 2\n",
         "F 7 north");
    same("0,0,-1,F1,1\n0,0,-3,F1,1\n5,0,-1,F1,2\n5,0,-3,F1,2\n", "F1");
    same("F1 0 0 -1 a\nF1 0 0 -3 a\nF1 5 0 -1 b\nF1 5 0 -3 b\n", "F1");
    same("# RMS\n0 0 -1\n0 0 -3\n999 999 999\n5 0 -1\n5 0 -3\n999 999 999\nEOD\n1 1\n", "a");
    same("stick,x,y,z,fault\n1,0,0,-1,F 1\n1,0,0,-3,F 1\n1,2,2,-999.25,F 1\n2,5,0,-1,F "
         "1\n2,5,0,-3,F 1\n",
         "F 1");
    same("X Y Z Stick_ID\n0 0 -1 1\n0 0 -3 1\n5 0 -1 2\n5 0 -3 2\n", "a");
}

TEST_CASE("fault sticks: faults whose sticks take turns", "[io][sticks]") {
    const auto faults =
        read_them("0 0 1 B 1\n0 0 0 B 1\n9 9 1 A 1\n9 9 0 A 1\n1 0 1 B 2\n1 0 0 B 2\n"
                  "9 8 1 A 2\n9 8 0 A 2\n7 7 7 lonely 1\n7 7 6 lonely 1\n");
    REQUIRE(faults.size() == 2); // a single stick makes no surface
    CHECK(faults[0].name == "B");
    CHECK(faults[1].name == "A");
    CHECK(faults[1].vertices[2] == Point3{9, 8, 1});
}

TEST_CASE("fault sticks: depths", "[io][sticks]") {
    const auto fault =
        read_them("x y depth_ft stick\n0 0 0 1\n0 0 3 1\n5 0 1 2\n", {.depth = true})[0];
    CHECK(fault.vertices == std::vector<Point3>{{0, 0, 0}, {0, 0, -3}, {5, 0, -1}});
    CHECK(fault.frame.vertical_axis == VerticalAxis::down);
    CHECK(fault.frame.vertical_unit == "ft");
}

TEST_CASE("fault sticks: what can't be read is named with its line", "[io][sticks]") {
    CHECK(message_of_sticks("") == "a: there is no point");
    CHECK(message_of_sticks("words only\n") == "a: there is no point");
    CHECK(message_of_sticks("0 0 0 1\n1 2\n") == "a:2: a point needs 3 numbers");
    CHECK(message_of_sticks("INLINE- 1 2 3 4\n") ==
          "a:1: a point needs inline, crossline, x, y and z");
    CHECK(message_of_sticks("0 0 inf 1\n") == "a:1: \"inf\" is not a finite number");
    CHECK(message_of_sticks("x,y,z,stick\n1,2,3,1\n1,2,3\n") ==
          "a:3: the heading has 4 columns, this line 3");
    CHECK(
        message_of_sticks("0 0 0\n0 0 1\n") ==
        "a: no fault has two sticks or a closed line; a column with the number of the stick, or a "
        "line 999 999 999 after each stick, tells them apart");
}

TEST_CASE("fault sticks: a file of another program", "[io][sticks]") {
    const auto read = read_surfaces(test_data() + "/subsurface/faultsticks.dat", Format::sticks);
    if (!read) FAIL(read.error().message());
    REQUIRE(read->size() == 1);
    const Surface& fault = read->front();
    CHECK(fault.name == "gp_fault7");
    CHECK(fault.vertices.size() == 12);
    CHECK(fault.vertices[4] == Point3{757268.95681, 3787540.23798, 1881.46707});
    CHECK(fault.triangles.size() == 12); // three strips of four
}

TEST_CASE("fault sticks: a closed line is filled, with its own points only", "[io][sticks]") {
    // An L in the plane y = x, seen from the side; the last line repeats its first point twice.
    const std::string upright = "0 0 0\n4 4 0\n4 4 -2\n2 2 -2\n2 2 -5\n0 0 -5\n0 0 -5\n0 0 0\n";
    for (const std::string& text : {upright + "999 999 999\n", upright}) {
        const auto faults = read_them(text);
        REQUIRE(faults.size() == 1);
        CHECK(faults[0].role == Role::fault);
        CHECK(faults[0].vertices ==
              std::vector<Point3>{
                  {0, 0, 0}, {4, 4, 0}, {4, 4, -2}, {2, 2, -2}, {2, 2, -5}, {0, 0, -5}});
        REQUIRE(faults[0].triangles.size() == 4);
        double area = 0; // of the projection to x and z
        for (const Triangle& t : faults[0].triangles) {
            const Point3 &a = faults[0].vertices[t[0]], &b = faults[0].vertices[t[1]],
                         &c = faults[0].vertices[t[2]];
            area += (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
        }
        CHECK(std::abs(area) == 2 * (4 * 2 + 2 * 3));
    }
    // Polygons of one fault stay apart, and sticks between them are strips as before.
    const auto mixed = read_them("0 0 0 F 1\n2 0 0 F 1\n2 2 1 F 1\n0 0 0 F 1\n"
                                 "9 0 0 F 2\n9 0 -1 F 2\n8 0 0 F 3\n8 0 -1 F 3\n"
                                 "5 5 5 G 1\n6 5 5 G 1\n6 6 5 G 1\n5 5 5 G 1\n");
    REQUIRE(mixed.size() == 2);
    CHECK(mixed[0].triangles.size() == 3);
    CHECK(mixed[1].triangles.size() == 1);
    CHECK(mixed[1].vertices.size() == 3);
}

TEST_CASE("fault sticks: a closed line that crosses itself is refused", "[io][sticks]") {
    const std::string sentence =
        " touches or crosses itself, seen along the normal of its plane of "
        "least squares";
    CHECK(message_of_sticks("0 0 0\n4 0 4\n4 0 0\n0 0 4\n0 0 0\n") ==
          "a: closed line 1 of \"a\": the line" + sentence);
    CHECK(message_of_sticks("9 9 9 F 1\n9 8 8 F 1\n0 0 0 F 2\n2 0 0 F 2\n0 0 2 F 2\n0 0 0 F 2\n"
                            "0 1 0 F 3\n4 0 4 F 3\n4 1 0 F 3\n0 0 4 F 3\n0 1 0 F 3\n") ==
          "a: closed line 2 of \"F\": the line" + sentence);
    // Without an inside there is no surface.
    CHECK(message_of_sticks("1 1 1\n1 1 1\n1 1 1\n1 1 1\n").starts_with("a: no fault has two"));
}
