// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane section`; section_files.py reads its files back.
#include <string>

#include <catch2/catch.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

const std::string in_box = " --box 0,0,0,8,8,8 -o out.svg ";

/// Levels at z = 2 and 5.
std::string two_levels(const Folder& folder) {
    return folder.input("lower.obj", level("lower", "2")) + " " +
           folder.input("upper.obj", level("upper", "5"));
}

} // namespace

TEST_CASE("cli: section states polygons, lines and the area", "[cli]") {
    const Folder folder;
    const auto in = two_levels(folder);
    const auto r = folder.run("section " + in + in_box + "--plane 4,4,4,0,-1,0 --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "section: 3 polygons of 3 blocks, area 64; 6 lines of 6 surfaces\n"));
    CHECK(contains(r.out, "wrote out.svg\n"));
    const auto section = Json::parse(folder.read("s.json"))["section"];
    CHECK(section["polygons"] == 3);
    CHECK(section["area"] == 64);
    CHECK(contains(folder.run("section " + in + in_box + "--fence 0,4,4,4,4,8").out, "area 64;"));
    CHECK(contains(folder.run("section " + in + in_box + "--level 1,3,6").out, "area 192;"));
    CHECK(contains(folder.run("section " + in + in_box + "--by upper").out, "area 64;"));
    folder.input("line.txt", "0 4\n4 4\n4 8\n");
    CHECK(contains(folder.run("section " + in + in_box + "--fence in/line.txt").out, "area 64;"));
    folder.input("slope.obj", polygon("slope", "-1 -1 1, 9 -1 1, 9 9 6, -1 9 6"));
    CHECK(contains(folder.run("section " + in + in_box + "--by in/slope.obj").out,
                   "section: 3 polygons of 3 blocks"));
}

TEST_CASE("cli: section without blocks has lines alone", "[cli]") {
    const Folder folder;
    const auto in = folder.input("slope.obj", polygon("slope", "0 0 0, 8 0 4, 8 8 4, 0 8 0"));
    const auto r = folder.run("section " + in + " -o out.csv --contours 1");
    CHECK(r.status == 0);
    CHECK(contains(r.out, "contours: 5 lines\n"));
    CHECK(contains(folder.read("out.csv"), "line,,,,slope,2,"));
    const auto lines = folder.run("section " + in + " -o out.dxf --plane 0,4,0,0,1,0");
    CHECK(contains(lines.out, "1 line of 1 surface\nThe section meets no closed block; "));
    CHECK(folder.run("section " + in + " -o out.obj --plane 0,4,0,0,1,0").status == 2);
    const auto none = folder.run("section " + in + " -o none.svg --level 9");
    CHECK(none.status == 1);
    CHECK(contains(none.err, "nothing written: the section does not meet the model"));
    CHECK(folder.left().count("none.svg") == 0);
}

TEST_CASE("cli: section to standard output", "[cli]") {
    const Folder folder;
    const auto in = two_levels(folder);
    const auto r = folder.run("section " + in +
                              " --box 0,0,0,8,8,8 --level 1 -o - "
                              "--output-format geojson --quiet");
    CHECK(r.status == 0);
    CHECK(r.err.empty());
    CHECK(Json::parse(r.out)["features"].size() == 5); // a polygon, and its four sides
    CHECK(folder.run("section " + in + in_box + "--level 1 -o - -o - --output-format svg").status ==
          2);
}

TEST_CASE("cli: section names mistakes with their options", "[cli]") {
    const Folder folder;
    const auto in = two_levels(folder);
    const auto refusal = [&](const std::string& options) {
        const auto r = folder.run("section " + in + in_box + options);
        CHECK(r.status == 2);
        CHECK((r.out.empty() || contains(options, "contours"))); // before the model is made
        return r.err;
    };
    CHECK(contains(refusal(""), "one of these must be given"));
    CHECK(contains(refusal("--level 1 --by upper"), "one of these must be given"));
    CHECK(contains(refusal("--plane 1,2,3"), "--plane: needs six numbers"));
    CHECK(contains(refusal("--plane 1,2,3,0,0,0"), "--plane: the normal"));
    CHECK(contains(refusal("--fence 1,2,3"), "--fence: needs pairs"));
    CHECK(contains(refusal("--fence 0,0,4,0,2,0"), "--fence: the fence crosses or touches itself"));
    CHECK(contains(refusal("--fence none.txt"), "--fence: is neither numbers"));
    CHECK(contains(refusal("--level x"), "--level: needs numbers"));
    CHECK(contains(refusal("--contours 1e-9"), "--contours: makes more than 10000"));
    CHECK(contains(refusal("--contours 100 --box 0,0,1,8,8,8"), "--box"));
    CHECK(contains(refusal("--by uper"), "did you mean upper?"));
    CHECK(contains(refusal("--level 1 -o -"), "must be given: --output-format"));
    folder.input("cube.obj", level("a", "1") + level("b", "2"));
    CHECK(contains(refusal("--by in/cube.obj"), "--by: has several surfaces"));
    CHECK(contains(refusal("--level 1 -o out.xyz"), "this format is read, not written"));
    folder.input("folded.obj", "o folded\nv 0 0 1\nv 8 0 1\nv 8 8 2\nv 0 8 3\nv 4 4 7\nv 4 4 -7\n"
                               "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 1 3 6\nf 2 4 6\n");
    CHECK(contains(refusal("--by in/folded.obj"), "--by: the surface folds over"));
}
