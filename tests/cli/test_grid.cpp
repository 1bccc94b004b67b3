// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane grid`; cell_files.py reads its files back.
#include <string>

#include <catch2/catch.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

const std::string in_cube = " --box 0,0,0,8,8,8 ";

} // namespace

TEST_CASE("cli: grid states cells, and the volume in them", "[cli]") {
    const Folder folder;
    const auto in = folder.input("flat.obj", level("flat", "3"));
    const auto r =
        folder.run("grid " + in + in_cube + "--cells 2,2,4 -o out.csv -o out.vti --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "grid: 2 x 2 x 4 cells, 16 with the centre in a block, 4 divided; volume "
                          "of blocks 512\n"));
    CHECK(contains(r.out, "wrote out.csv\nwrote out.vti\n"));
    // the centre of the second layer is on the surface, and counts to the block above
    CHECK(contains(folder.read("out.csv"), "1,1,2,2,2,3,1,below flat,,0.5,0\n"
                                           "1,1,2,2,2,3,2,above flat,,0.5,1\n"));
    const auto grid = Json::parse(folder.read("s.json"))["grid"];
    CHECK(grid["cells"] == 16);
    CHECK(grid["inside"] == 16);
    CHECK(grid["divided"] == 4);
    CHECK(grid["volume"] == 512);
    const auto outside = folder.run("grid " + in + in_cube + "--step 3 -o out.vtr");
    CHECK(contains(outside.out, "grid: 3 x 3 x 3 cells, "));
    CHECK(contains(outside.out, "volume of blocks 512\n"));
    CHECK(folder.run("grid " + in + in_cube + "--step 3 --z 0,1,8 -o out.grdecl").status == 0);
}

TEST_CASE("cli: grid refuses what makes no sense", "[cli]") {
    const Folder folder;
    const auto in = folder.input("flat.obj", level("flat", "3"));
    const auto refused = [&](const std::string& options) {
        const auto r = folder.run("grid " + in + in_cube + options);
        CHECK(r.status == 2);
        CHECK(folder.left().count("no.vti") == 0);
        return r.err;
    };
    CHECK(contains(refused("-o no.vti"), "give either --step or --cells"));
    CHECK(contains(refused("-o no.vti --step 1 --cells 1,1,1"), "give either --step or --cells"));
    CHECK(contains(refused("-o no.vti --step 1,2"), "needs one number, or three"));
    CHECK(contains(refused("-o no.vti --cells 1,2"), "needs three numbers"));
    CHECK(contains(refused("-o no.vti --cells 1,2,1.5"), "needs whole numbers"));
    CHECK(contains(refused("-o no.vti --step -1"), "--step: a step of the grid is not positive"));
    CHECK(contains(refused("-o no.vti --step 1e-9"), "more than 10^9 cells"));
    CHECK(contains(refused("-o no.vti --step 2 --z 0,1,8"), ".vtr has such"));
    CHECK(contains(refused("-o no.vti --step 2 --z 1,0"), "not ascending"));
    CHECK(contains(refused("-o no.obj --step 2"), ".vti, .vtr, .grdecl or .csv"));
    const auto open = folder.run("grid " + in + " --step 2 -o no.vti");
    CHECK(open.status == 1);
    CHECK(contains(open.err, "nothing written: no block has volume in the grid"));
    CHECK(folder.left().count("no.vti") == 0);
}

TEST_CASE("cli: prisms states cells, gaps and the volume", "[cli]") {
    const Folder folder;
    const auto top = folder.input("top.obj", polygon("top", "0 0 4, 8 0 4, 8 8 4, 0 8 4"));
    const auto base = folder.input("base.obj", level("base", "1"));
    const auto r = folder.run("prisms " + top + " " + base +
                              " --layers 3 -o out.vtu -o out.msh --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "prisms: 6 prisms, 0 pyramids, 0 tetrahedra; 16 nodes; volume 192\n"));
    CHECK(contains(r.out, "wrote out.vtu\nwrote out.msh\n"));
    CHECK(Json::parse(folder.read("s.json"))["prisms"]["volume"] == 192);
    CHECK(contains(folder.read("out.msh"), "3 1 \"layer 1\""));
    const auto parallel = folder.run("prisms " + top + " " + base +
                                     " --layers 3 --follow top --thickness 2 -o out.vtu");
    CHECK(contains(parallel.out, "prisms: 4 prisms, "));
    const auto gaps = folder.run("prisms " + base + " " + top + " -o none.vtu");
    CHECK(gaps.status == 1);
    CHECK(contains(gaps.err, "nothing written: there is no space between the surfaces"));
    CHECK(folder.left().count("none.vtu") == 0);
    const auto half = folder.input("half.obj", polygon("half", "0 0 1, 8 0 1, 8 8 1"));
    CHECK(contains(folder.run("prisms " + top + " " + half + " -o out.vtu").err,
                   "the base is missing below a corner of 1 triangle, on which no prism stands; "
                   "the first is 1 of the top, at x = "));
}

TEST_CASE("cli: prisms refuses what makes no sense", "[cli]") {
    const Folder folder;
    const auto top = folder.input("top.obj", level("top", "4"));
    const auto base = folder.input("base.obj", level("base", "1"));
    const auto refused = [&](const std::string& options) {
        const auto r = folder.run("prisms " + options);
        CHECK(r.status == 2);
        return r.err;
    };
    CHECK(contains(refused(top + " -o no.vtu"), "needs two surfaces, the top first, and has 1"));
    const std::string both = top + " " + base;
    CHECK(contains(refused(both + " -o no.obj"), "prisms are .vtu or .msh"));
    CHECK(contains(refused(both + " -o no.vtu --layers 0"), "--layers: "));
    CHECK(contains(refused(both + " -o no.vtu --follow top"), "--thickness: "));
    CHECK(contains(refused(both + " -o no.vtu --thickness 1"), "--thickness: "));
    folder.input("wall.obj", polygon("wall", "0 0 0, 8 0 0, 8 0 8"));
    CHECK(contains(refused(top + " in/wall.obj -o no.vtu"), "wall"));
    CHECK(folder.left().count("no.vtu") == 0);
}

TEST_CASE("cli: pillars states cells, and names what is missing", "[cli]") {
    const Folder folder;
    const auto top = folder.input("top.obj", level("top", "4"));
    const auto base = folder.input("base.obj", polygon("base", "0 0 1, 8 0 1, 8 8 1, 0 8 1"));
    const std::string both = top + " " + base;
    const auto r =
        folder.run("pillars " + both + " --step 4 --layers 3 -o out.grdecl --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "pillars: 2 x 2 x 3 cells, 12 active\nwrote out.grdecl\n"));
    CHECK(Json::parse(folder.read("s.json"))["pillars"]["active"] == 12);
    CHECK(contains(folder.read("out.grdecl"), "SPECGRID\n2 2 3 1 F /"));
    const auto wide = folder.run("pillars " + both + " --x 0,4,9 --y 0,4 -o out.grdecl");
    CHECK(contains(wide.out, "pillars: 2 x 1 x 1 cells, 1 active\n"));
    CHECK(contains(wide.err,
                   "a horizon is missing at pillars of 1 column; the first is column 2, 1, base"));
    const auto none = folder.run("pillars " + base + " " + top + " --step 4 -o none.grdecl");
    CHECK(none.status == 1);
    CHECK(contains(none.err, "nothing written: no cell is active"));
    for (const std::string options :
         {"", "--step 4 --x 0,1", "--x 0,1", "--x 0,1 --y 1,0", "--step 4 --layers 0", "--step -1",
          "--step 4 --layers 1,2,3"})
        CHECK(folder.run("pillars " + both + " -o none.grdecl " + options).status == 2);
    CHECK(folder.run("pillars " + top + " --step 4 -o none.grdecl").status == 2);
    CHECK(folder.run("pillars " + both + " --step 4 -o none.vtu").status == 2);
    CHECK(folder.left().count("none.grdecl") == 0);
}
