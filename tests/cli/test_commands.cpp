// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests each command from outside.
#include <cmath>
#include <cstdint>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <terrane/algorithms/core/figure.hpp>

#include "program.hpp"
#include "support/effort.hpp"

using namespace program_test;

namespace {

const std::string real_model = "$D/arch-platform/faults.ts $D/arch-platform/mnt.ts";

} // namespace

TEST_CASE("cli: arrange makes a conforming mesh and says what it did", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    const auto r = folder.run("arrange " + in + " -o out.obj -o out.vtp --stats s.json");
    CHECK(r.status == 0);
    CHECK(r.err.empty());
    CHECK(contains(r.out, "2 surfaces: 3 triangles -> 13, 2 intersection edges, 3 regions\n"));
    CHECK(contains(r.out, "verified: the doubles are a conforming mesh"));
    CHECK(folder.left() == std::set<std::string>{"out.obj", "out.vtp", "s.json"});
    CHECK(folder.run("check " + in).status == 1);
    CHECK(folder.run("check out.obj").status == 0);
}

TEST_CASE("cli: statistics have the promised keys", "[cli]") {
    const Folder folder;
    REQUIRE(folder.run("arrange " + real_model + " -o out.obj --stats s.json").status == 0);
    const auto json = Json::parse(folder.read("s.json"));
    for (const std::string key :
         {"/input/surfaces",      "/input/triangles",   "/input/vertices",
          "/output/triangles",    "/output/vertices",   "/output/intersection_edges",
          "/output/regions",      "/output/volumes",    "/search/method",
          "/search/candidates",   "/search/tests",      "/predicates/static",
          "/predicates/interval", "/predicates/exact",  "/rounding/iterations",
          "/rounding/max_move",   "/rounding/verified", "/seconds/read",
          "/seconds/search",      "/seconds/intersect", "/seconds/triangulate",
          "/seconds/round",       "/seconds/write",     "/seconds/total",
          "/peak_rss_mb",         "/constants/read",    "/constants/round/many"}) {
        INFO(key);
        CHECK(json.contains(Json::json_pointer(key)));
    }
    CHECK(json["input"]["surfaces"] == 33);
    CHECK(json["input"]["triangles"] == 22712);
    CHECK(json["search"]["improper_contacts"] == 3382);
    CHECK(json["search"]["method"] == "hierarchy"); // what auto stands for
    CHECK(json["rounding"]["verified"] == true);
    CHECK(json["seconds"]["total"].get<double>() > 0);
    CHECK(json["constants"]["round"]["coarse_digits_1"] == 9);
    CHECK_FALSE(json["constants"].contains("improve")); // a stage that was not run
    CHECK(json["peak_rss_mb"].get<double>() > 1);

    const auto in = folder.input("model.obj", crossing);
    const auto method = [&](const std::string& options) {
        REQUIRE(folder.run("arrange " + in + " -o out.obj --stats s.json" + options).status == 0);
        return Json::parse(folder.read("s.json"))["search"]["method"].get<std::string>();
    };
    CHECK(method("") == "brute"); // for so few triangles
    CHECK(method(" --search ab-median") == "ab-median");
}

TEST_CASE("cli: the same bytes for any number of threads and any search", "[cli][once]") {
    const Folder folder;
    for (const std::string format : {"obj", "vtp"}) {
        const auto arrange = [&](const std::string& options) {
            const auto out = "out." + format;
            REQUIRE(folder.run("arrange " + real_model + " -o " + out + " " + options).status == 0);
            return folder.read(out);
        };
        const auto expected = arrange("--threads 1");
        CHECK(arrange("--threads 2") == expected);
        CHECK(arrange("") == expected);
        for (const std::string method :
             {"grid", "ab", "ab-balanced", "ab-median", "mixed", "hierarchy", "brute"}) {
            INFO(method);
            CHECK(arrange("--search " + method) == expected);
        }
    }
}

TEST_CASE("cli: the summary counts what decided each pair; --check full tests all", "[cli]") {
    const Folder folder;
    const auto counts_of = [&](const std::string& options, bool full) {
        const auto r = folder.run("arrange " + real_model + " -o out.obj --stats s.json" + options);
        REQUIRE(r.status == 0);
        const auto json = Json::parse(folder.read("s.json"));
        const auto& pairs = json["rounding"]["pairs"];
        const auto count = [&](const char* key) { return pairs.at(key).get<std::uint64_t>(); };
        const std::uint64_t n = json["output"]["triangles"];
        const std::uint64_t cleared = count("in_patches") + count("separated");
        CHECK(count("tested") + cleared + count("unmoved") + count("apart") == n * (n - 1) / 2);
        CHECK(contains(r.out, "pairs of triangles: " + std::to_string(count("tested")) +
                                  " tested by exact predicates; " + std::to_string(cleared) +
                                  " cleared by proven bounds ("));
        CHECK((cleared + count("unmoved") == 0) == full);
        return count("apart");
    };
    const auto apart = counts_of("", false);
    const auto mesh = folder.read("out.obj");
    CHECK(counts_of(" --check full", true) == apart);
    CHECK(folder.read("out.obj") == mesh);
    const auto improved = folder.run("improve out.obj -o better.obj --check full --stats s.json");
    CHECK(improved.status == 0);
    CHECK(Json::parse(folder.read("s.json"))["improve"]["pairs"]["in_patches"] == 0);
    const auto wrong = folder.run("arrange " + real_model + " -o no.obj --check most");
    CHECK(wrong.status == 2);
    CHECK(contains(wrong.err, "--check"));
}

TEST_CASE("cli: no surface moves farther than --max-move", "[cli][once]") {
    const Folder folder;
    const std::string arrange_utm = "arrange $D/rounding/utm.obj -o out.obj --stats s.json";
    REQUIRE(folder.run(arrange_utm).status == 0);
    const auto rounding = Json::parse(folder.read("s.json"))["rounding"];
    const double moved = rounding["surface_deviation"];
    CHECK(moved < 1e-8);
    CHECK(rounding["max_allowed"] == 1024 * 0x1p-31);
    CHECK(rounding["max_move"] <= moved);

    // A smaller limit is kept, too, by smaller moves; the least move with which the surfaces can be
    // separated is allowed, and the double below it is refused.
    const auto deviation_within = [&](double limit) {
        const auto r = folder.run(fmt::format("{} --max-move {}", arrange_utm, limit));
        CAPTURE(limit, r.err);
        REQUIRE(r.status == 0);
        const double found = Json::parse(folder.read("s.json"))["rounding"]["surface_deviation"];
        CHECK(found <= limit);
        return found;
    };
    for (const double limit : {1e-8, moved, std::nextafter(moved, 0.0), 1e-9})
        deviation_within(limit);
    double least = deviation_within(6e-10);
    const auto is_conforming = [&](double limit) {
        return folder.run(fmt::format("{} --max-move {}", arrange_utm, limit)).status == 0;
    };
    for (int i = 0; i < 20 && is_conforming(std::nextafter(least, 0.0)); ++i)
        least = deviation_within(std::nextafter(least, 0.0));
    CHECK(deviation_within(least) == least);
    const Folder other;
    const double below = std::nextafter(least, 0.0);
    const auto refused = other.run(fmt::format("{} --max-move {}", arrange_utm, below));
    CHECK(refused.status == 1);
    CHECK(contains(refused.out, "no surface may move by more than " + terrane::figure(below, 3) +
                                    " to separate them"));
    CHECK(contains(refused.err, "(part of "));
    CHECK(other.left() == std::set<std::string>{"s.json"});
    // It is more than where the nearest doubles are, at which some surfaces cross.
    const double nearest = Json::parse(other.read("s.json"))["rounding"]["surface_deviation"];
    CHECK(nearest < below);
    CHECK(other.run(fmt::format("{} --max-move {}", arrange_utm, nearest)).status == 1);
    CHECK(other.run(fmt::format("{} --max-move {}", arrange_utm, nearest / 2)).status == 2);
    const auto never = other.run(arrange_utm + " --max-move 1e-12");
    CHECK(never.status == 2);
    CHECK(contains(never.err, "--max-move: "));
    CHECK(other.run(arrange_utm + " --max-move 0").status == 2);
    CHECK(other.run(arrange_utm + " --max-move inf").status == 2);
}

TEST_CASE("cli: doubles that are not conforming are refused, by name", "[cli]") {
    const Folder folder;
    const auto in = folder.input("tiny.off", tiny_triangles());
    const auto refused = folder.run("arrange " + in + " -o out.off --rounds 0 --stats s.json");
    CHECK(refused.status == 1);
    CHECK(contains(refused.out, "NOT verified: "));
    CHECK(contains(refused.err, "(part of tiny triangle "));
    CHECK(contains(refused.err, " at (4194304.0"));
    CHECK(contains(refused.err, "nothing written"));
    CHECK(folder.left() == std::set<std::string>{"s.json"});
    CHECK(Json::parse(folder.read("s.json"))["rounding"]["verified"] == false);

    const auto proved = folder.run("arrange " + in + " -o out.off --rounds 0 --certificate c.json");
    CHECK(proved.status == 1);
    CHECK(contains(proved.err, "the mesh is not written"));
    CHECK_FALSE(contains(proved.err, "nothing written")); // as the certificate is
    CHECK(folder.left() == std::set<std::string>{"c.json", "s.json"});

    const auto kept = folder.run("arrange " + in + " -o out.off --rounds 0 --keep-unverified");
    CHECK(kept.status == 1);
    CHECK(folder.run("check out.off").status == 1);

    CHECK(folder.run("arrange " + in + " -o out.off").status == 0);
    CHECK(folder.run("check out.off").status == 0);
    const auto narrow = folder.run("arrange " + in + " -o out.stl");
    CHECK(narrow.status == 1); // in float32 all corners are one point
    CHECK(contains(narrow.err, "float32"));
    CHECK(!folder.left().contains("out.stl"));
    CHECK(folder.run("arrange " + in + " -o out.stl --ascii").status == 0);
}

TEST_CASE("cli: check locates what it finds", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", std::string(crossing) + "f 5 6 6\nf 6 7 5\n");
    const auto text = folder.run("check " + in);
    CHECK(text.status == 1);
    CHECK(contains(text.out, "in/model.obj: 2 surfaces, 5 triangles, 7 distinct vertices"));
    CHECK(contains(text.out, "horizon triangle 0 and fault triangle 0: crossing at (1, "));
    CHECK(contains(text.out, "fault triangle 1: corner at (1, -1, -1)"));
    CHECK(contains(text.out, "fault triangle 2 repeats fault triangle 0: "));

    const auto r = folder.run("check --json " + in);
    CHECK(r.status == 1);
    const auto json = Json::parse(r.out);
    CHECK(json["clean"] == false);
    CHECK(json["surfaces"][1]["name"] == "fault");
    CHECK(json["degenerate"] == Json::parse(R"([{"surface": 1, "triangle": 1}])"));
    CHECK(json["repeated"][0]["triangle"]["triangle"] == 2);
    CHECK(json["improper_contacts"][0]["kind"] == "crossing");
    CHECK(json["improper_contacts"][0]["place"][0] == 1.0);
}

TEST_CASE("cli: info says what files contain", "[cli]") {
    const Folder folder;
    const auto ts = folder.input(
        "top.ts",
        "GOCAD TSurf 1\nHEADER {\nname:top\n}\nGEOLOGICAL_TYPE top\nPROPERTIES Poro\nUNITS %\n"
        "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME UTM31\nAXIS_UNIT m m m\nZPOSITIVE Depth\n"
        "END_ORIGINAL_COORDINATE_SYSTEM\nTFACE\nPVRTX 1 0 0 5 .2\nPVRTX 2 4 0 5 .2\n"
        "PVRTX 3 0 4 6 .2\nTRGL 1 2 3\nEND\n");
    const auto grid = folder.input("g.dat", "ncols 2\nnrows 2\nxllcorner -4.5\nyllcorner -4.5\n"
                                            "cellsize 9\n-5.5 -5.5\n-5.5 -5.5\n");
    const auto text = folder.run("info " + ts + " " + grid);
    CHECK(text.status == 0);
    CHECK(contains(text.out, "top.ts: GOCAD, 1 surface\n"));
    CHECK(contains(text.out,
                   "  top      horizon          1         3      1  open, 3 border edges  none\n"));
    CHECK(contains(text.out, "  from (0, 0, -6) to (4, 4, -5)\n"));
    CHECK(contains(text.out, "  states: x and y in m; z in m; z is a depth, which was turned over; "
                             "coordinate system UTM31\n"));
    CHECK(contains(text.out, "  values: Poro in %\n"));
    CHECK(contains(text.out, "g.dat: ESRI ASCII grid, 1 surface\n"));
    CHECK(
        contains(text.out, "2 pairs of triangles of different surfaces cross, touch or overlap\n"));
    const auto coloured =
        folder.input("c.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n");
    const auto colours = folder.run("info " + coloured);
    CHECK(contains(colours.out, "  values, which are not read: colours\n"));
    CHECK(contains(colours.err, "c has values that are not read: colours"));

    const auto r = folder.run("info --json " + ts + " " + grid);
    CHECK(r.status == 0);
    const auto json = Json::parse(r.out);
    const auto& top = json["files"][0]["surfaces"][0];
    CHECK(top["vertical_axis"] == "depths");
    CHECK(top["free_border_edges"] == 3);
    CHECK(top["high"] == Json::parse("[4.0, 4.0, -5.0]"));
    CHECK(
        top["values"] ==
        Json::parse(
            R"([{"name": "Poro", "on": "vertices", "type": "float64", "components": 1, "unit": "%"}])"));
    CHECK(top["values_not_read"].empty());
    CHECK(json["files"][1]["surfaces"][0]["triangles"] == 2);
    CHECK(json["contacts_of_surfaces"] == 2);
    CHECK(json["warnings"].empty());
    CHECK(folder.run("info --strict " + coloured).status == 2);
    CHECK(folder.run("info none.ts").status == 2);
    CHECK(folder.run("info " + folder.input("solid.obj", cube)).status == 0);
}

TEST_CASE("cli: check lists all only when asked", "[cli][once]") {
    const Folder folder;
    const auto some = folder.run("check " + real_model);
    CHECK(some.status == 1);
    CHECK(contains(some.out, "improper contacts: 3382 (3307 crossing, "));
    CHECK(contains(some.out, "  and 3372 more (--all lists them)"));
    const auto all = folder.run("check --all " + real_model);
    CHECK(std::count(all.out.begin(), all.out.end(), '\n') == 3382 + 6);
    CHECK(Json::parse(folder.run("check --json " + real_model).out)["improper_contacts"].size() ==
          3382);
}

TEST_CASE("cli: convert changes the format and nothing else", "[cli]") {
    const Folder folder;
    const auto in = folder.input("a.obj", "o top\nv 0.1 1e-300 4503599627370495.5\nv 1 0 0\n"
                                          "v 0 -1e22 0\nf 1 2 3\nf 3 2 1\n");
    REQUIRE(folder.run("convert " + in + " b.ts").status == 0);
    REQUIRE(folder.run("convert b.ts c.ply").status == 0);
    REQUIRE(folder.run("convert c.ply d.obj").status == 0);
    REQUIRE(folder.run("convert " + in + " e.obj").status == 0);
    CHECK(folder.read("d.obj") == folder.read("e.obj"));
    CHECK(contains(folder.read("d.obj"), "4503599627370495.5"));
    const auto narrow = folder.run("convert " + in + " f.stl");
    CHECK(narrow.status == 0);
    CHECK(contains(narrow.err, "warning: f.stl: coordinates were rounded to float32"));
    CHECK(folder.run("convert " + in + " f.stl --ascii").err.empty());
}

TEST_CASE("cli: arrange and convert write for other mesh generators", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    REQUIRE(folder.run("arrange " + in + " -o a.msh --msh 2.2 -o a.inp -o a.mesh").status == 0);
    CHECK(contains(folder.read("a.msh"), "$MeshFormat\n2.2 0 8\n"));
    CHECK(contains(folder.read("a.inp"), "*ELSET, ELSET=FAULT\n"));
    CHECK(contains(folder.read("a.mesh"), "# 2: fault\n"));
    REQUIRE(folder.run("convert " + in + " b.msh").status == 0);
    CHECK(contains(folder.read("b.msh"), "$MeshFormat\n4.1 0 8\n"));
    REQUIRE(folder.run("convert " + in + " b.msh --msh 2.2").status == 0);
    CHECK(contains(folder.read("b.msh"), "$MeshFormat\n2.2 0 8\n"));
    const auto wrong = folder.run("convert " + in + " c.msh --msh 3");
    CHECK(wrong.status == 2);
    CHECK(contains(wrong.err, "--msh"));
    const auto unread = folder.run("convert a.inp c.obj");
    CHECK(unread.status == 2);
    CHECK(contains(unread.err, "this format is written, not read"));
    CHECK(folder.left() == std::set<std::string>{"a.msh", "a.inp", "a.mesh", "b.msh"});
}

TEST_CASE("cli: arrange puts a point into each block for TetGen", "[cli]") {
    const Folder folder;
    const auto in = folder.input("two.off", "OFF\n8 8 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n"
                                            "9 0 0\n13 0 0\n9 4 0\n9 0 4\n"
                                            "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
                                            "3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n");
    REQUIRE(folder.run("arrange " + in + " -o a.poly -o a.smesh").status == 0);
    for (const std::string name : {"a.poly", "a.smesh"}) {
        const auto text = folder.read(name);
        INFO(text);
        std::istringstream regions(text.substr(text.find("# regions\n") + 10));
        int count = 0;
        REQUIRE(regions >> count);
        REQUIRE(count == 2);
        for (int r = 1; r <= 2; ++r) {
            double number = 0, x = 0, y = 0, z = 0, block = 0;
            REQUIRE(regions >> number >> x >> y >> z >> block);
            CHECK(block == r);
            x -= r == 1 ? 0 : 9;
            CHECK((x > 0 && y > 0 && z > 0 && x + y + z < 4));
        }
    }
    REQUIRE(folder.run("convert " + in + " b.smesh").status == 0); // does not look for blocks
    CHECK(contains(folder.read("b.smesh"), "# regions\n0\n"));
}

#ifdef TERRANE_HAS_TETGEN
TEST_CASE("cli: tetrahedralize reports checks and shapes", "[cli][once]") {
    const Folder folder;
    const auto r = folder.run("tetrahedralize $D/ringmesh/modelA1.ml -o a.msh --msh 2.2 -o a.inp "
                              "-o a.mesh --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(
        r.out,
        "checked: each triangle is a union of faces, each block is one that surfaces enclose"));
    CHECK(contains(r.out, "of 4 blocks exactly their tetrahedra"));
    CHECK(contains(r.out, "\ndihedral angles "));
    CHECK(contains(r.out, "\nratio of circumradius to shortest edge "));
    const auto json = Json::parse(folder.read("s.json"));
    const auto& check = json["tetrahedra"]["check"];
    CHECK(check["violations"].empty());
    const auto sum = [](const Json& counts) {
        std::size_t total = 0;
        for (const auto& count : counts) total += count.get<std::size_t>();
        return total;
    };
    const auto tetrahedra = json["tetrahedra"]["tetrahedra"].get<std::size_t>();
    CHECK(check["dihedral"]["histogram"].size() == 18);
    CHECK(sum(check["dihedral"]["histogram"]) == 6 * tetrahedra);
    CHECK(check["radius_edge"]["histogram"].size() == check["radius_edge"]["bounds"].size() + 1);
    CHECK(sum(check["radius_edge"]["histogram"]) == tetrahedra);
    CHECK(check["dihedral"]["min"] < 60);
    CHECK(check["dihedral"]["max"] > 71);
    CHECK(contains(folder.read("a.msh"), "$MeshFormat\n2.2 0 8\n"));
    CHECK(contains(folder.read("a.msh"), "\n3 32 \"block 1: ")); // after 3 numbers for each of 10
    CHECK(contains(folder.read("a.inp"), "\n** block 4: "));
    CHECK(contains(folder.read("a.mesh"), "\nTetrahedra\n" + std::to_string(tetrahedra) + "\n"));
}

TEST_CASE("cli: tetrahedralize finds the blocks that the model states", "[cli][once]") {
    const Folder folder;
    const auto r =
        folder.run("tetrahedralize $D/ringmesh/modelA1.ml -o out.vtu -o out.msh --stats s.json");
    CHECK(r.status == 0);
    CHECK(contains(r.out, " outside\n"));
    const auto json = Json::parse(folder.read("s.json"));
    CHECK(json["tetrahedra"]["blocks"] == 5);
    CHECK(json["output"]["volumes"] == 4);
}

TEST_CASE("cli: tetrahedralize with a box, and what it refuses", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    CHECK(folder.run("tetrahedralize " + in + " -o a.vtu --around -2,-2,-2,6,6,4").status == 0);
    const auto sized = folder.run("tetrahedralize " + in + " -o b.msh --edge-length 1");
    CHECK(sized.status == 0);
    const auto left = folder.left();
    for (const std::string bad :
         {"-o c.vtu --around 0,0,0,1,1,1", "-o c.vtu --around 1,2,3",
          "-o c.vtu --around a,b,c,d,e,f", "-o c.vtu --around -2,-2,-2,6,6,nan",
          "-o c.vtu --margin -1", "-o c.vtu --edge-length 0", "-o c.vtu --quality 0.5", "-o c.obj",
          "-o c.poly", "-o c.vtu -o c.vtp"}) {
        INFO(bad);
        const auto r = folder.run("tetrahedralize " + in + " " + bad);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "terrane: "));
    }
    const auto tiny = folder.input("tiny.off", tiny_triangles());
    const auto r = folder.run("tetrahedralize " + tiny + " -o c.vtu --rounds 0");
    CHECK(r.status == 1);
    CHECK(contains(r.err, "the doubles are not a conforming mesh"));
    CHECK(folder.left() == left);
}
#endif

TEST_CASE("cli: pairs of large meshes are counted on request", "[cli]") {
    constexpr int n = 160; // 51 200 triangles
    std::string sheet = "o sheet\n";
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            sheet += "v " + std::to_string(i) + " " + std::to_string(j) + " 0\n";
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = (n + 1) * j + i + 1;
            sheet += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
                     std::to_string(a + n + 2) + " " + std::to_string(a + n + 1) + "\n";
        }
    const Folder folder;
    const auto in = folder.input("sheet.obj", sheet);
    const auto says = [&](const std::string& more) {
        const auto made = folder.run("arrange " + in + " -o out.off" + more);
        CHECK(made.status == 0);
        return contains(made.out, "pairs of triangles: ");
    };
    CHECK_FALSE(says(""));
    CHECK(says(" --check bounds"));
    CHECK(says(" --check full"));
    CHECK_FALSE(says(" --stats s.json")); // statistics of a run cost no search of their own
    CHECK_FALSE(Json::parse(folder.read("s.json"))["seconds"].contains("count_pairs"));
}
