// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane volume` from outside.
#include <algorithm>
#include <map>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// A box, two horizons that reach beyond it, and a fault that ends inside it.
const std::string boxed_model = std::string("o box\n") + cube + level("base", "3") +
                                level("top", "5") + polygon("F1", "4 -1 -1, 4 4 -1, 4 4 9, 4 -1 9");

const std::string roles =
    " --role box=boundary --role base=horizon --role top=horizon --role F1=fault";

std::map<std::string, int> kinds_of(const Json& lines) {
    std::map<std::string, int> kinds;
    for (const auto& line : lines) ++kinds[line["kind"]];
    return kinds;
}

} // namespace

TEST_CASE("cli: arrange --memory finds the same volumes in tiles", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", boxed_model);
    // So little memory that space is divided.
    const auto r =
        folder.run("arrange " + in + " -o m.pvtp --memory 8KiB --volumes --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "3 closed blocks, volume 512 in all\n  block 1    volume "));
    const auto stats = Json::parse(folder.read("s.json"));
    CHECK(stats["tiles"] > 2);
    CHECK(stats["volumes"]["all"] == 512);
    REQUIRE(folder.run("convert m.pvtp m.vtp").status == 0);
    REQUIRE(folder.run("volume m.vtp -o model").status == 0);
    std::vector<double> expected;
    std::vector<std::string> names;
    const auto made = Json::parse(folder.read("model/model.json"));
    for (std::size_t b = 1; b < made["blocks"].size(); ++b) {
        expected.push_back(made["blocks"][b]["volume"]);
        names.push_back(made["blocks"][b]["name"]);
    }
    CHECK(stats["volumes"]["blocks"] == Json(expected));
    CHECK(stats["volumes"]["names"] == Json(names));
    for (const std::string& name : names) CHECK(contains(r.out, " " + name + "\n"));
    REQUIRE(folder.run("arrange " + in + " -o joined.vtp --memory 8KiB --volumes").status == 0);
    for (const std::string name : {"volume_front", "volume_back", "block_name"})
        CHECK(contains(folder.read("joined.vtp"), "Name=\"" + name + "\""));
    CHECK(contains(folder.read("m.pvtp"), "Name=\"volume_front\""));
    CHECK(folder.run("arrange " + in + " -o x.pvtp --memory 8KiB").status == 0);
    CHECK_FALSE(contains(folder.read("x.pvtp"), "volume"));
    const auto alone = folder.run("arrange " + in + " -o y.vtp --volumes");
    CHECK(alone.status == 2);
    CHECK(contains(alone.err, "--volumes: it needs --memory; terrane volume finds them without"));
}

TEST_CASE("cli: volume finds the blocks and writes them", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", boxed_model);
    const auto r = folder.run("volume " + in + " -o out --parts obj --stats s.json" + roles);
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(r.err.empty());
    CHECK(contains(r.out, "3 closed blocks, volume 512 in all\n"));
    CHECK(contains(r.out, "  block 2    volume 128              below top, above base\n"));
    CHECK(contains(r.out, "F1: 50 of 50 in area dangles"));
    CHECK(contains(r.out, "wrote out\n"));
    CHECK(folder.left() == std::set<std::string>{"out", "s.json"});

    const auto json = Json::parse(folder.read("out/model.json"));
    CHECK(json["format"] == "terrane-model 1");
    REQUIRE(json["blocks"].size() == 4);
    CHECK_FALSE(json["blocks"][0].contains("volume"));
    CHECK(json["blocks"][2]["volume"] == 128);
    CHECK(json["blocks"][2]["volume_written"] == 128);
    CHECK(json["blocks"][2]["above"] == Json{2});
    CHECK(json["blocks"][2]["below"] == Json{1});
    CHECK(json["blocks"][2]["neighbours"] == Json({0, 1, 3}));
    CHECK(json["surfaces"][3] ==
          Json({{"name", "F1"}, {"role", "fault"}, {"area", 50.0}, {"dangling_area", 50.0}}));
    CHECK(kinds_of(json["lines"])["cutoff line"] == 4);
    CHECK_FALSE(json["free_borders"].empty());
    const auto statistics = Json::parse(folder.read("s.json"));
    CHECK(statistics["output"]["volumes"] == 3);
    CHECK(statistics["volumes"]["blocks"] == Json({192, 128, 192}));

    // The folder has exactly the files that are named; each block is a closed surface without
    // flaws.
    std::vector<std::string> named{"model.json", "result.vtp"};
    for (const std::string part : {"blocks", "interfaces"})
        for (const auto& item : json[part])
            if (item.contains("file")) named.push_back(item["file"]);
    std::sort(named.begin(), named.end());
    CHECK(named.size() == 2 + 3 + json["interfaces"].size());
    REQUIRE(folder.shell("find out -type f | sed s,out/,, | LC_ALL=C sort > list").status == 0);
    std::string expected;
    for (const auto& name : named) expected += name + "\n";
    CHECK(folder.read("list") == expected);
    for (const auto& block : {"1", "2", "3"}) {
        const auto file = std::string("out/blocks/block_") + block + ".obj";
        CHECK(folder.run("check " + file).status == 0);
        const auto again = folder.run("volume " + file + " -o again" + block);
        CHECK(again.status == 0);
        CHECK(contains(again.out, "1 closed block, "));
        CHECK(contains(again.out, "no surface dangles"));
    }
}

TEST_CASE("cli: volume gives the same bytes for any number of threads", "[cli][once]") {
    const Folder folder;
    const std::string in = "$D/ringmesh/modelA2.ml";
    REQUIRE(folder.run("volume " + in + " -o one --threads 1").status == 0);
    REQUIRE(folder.run("volume " + in + " -o two --threads 2 --search grid").status == 0);
    CHECK(folder.shell("diff -r one two").status == 0);
    const auto json = Json::parse(folder.read("one/model.json"));
    CHECK(json["blocks"].size() == 13); // blocks that the file states, with the outside
}

TEST_CASE("cli: volume: open surfaces are no error, and enclose nothing", "[cli]") {
    const Folder folder;
    const auto in = folder.input("open.obj", crossing);
    const auto r = folder.run("volume " + in + " -o out");
    CHECK(r.status == 0);
    CHECK(contains(r.out, "0 closed blocks"));
    CHECK(contains(r.out, "horizon ends by fault"));
    CHECK(Json::parse(folder.read("out/model.json"))["blocks"].size() == 1);
}

TEST_CASE("cli: volume refuses what it can't do, and leaves nothing", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", boxed_model);
    const auto refused = [&](const std::string& arguments, int status, const std::string& reason) {
        const auto r = folder.run("volume " + in + " " + arguments);
        INFO(r.err);
        CHECK(r.status == status);
        CHECK(contains(r.err, reason));
    };
    refused("-o out --role F2=fault", 2, "no surface is called F2");
    refused("-o out --role F1=salt", 2, "needs NAME=ROLE");
    refused("-o out --role F1", 2, "needs NAME=ROLE");
    refused("-o nowhere/out", 2, "there is no folder nowhere");
    refused("-o in", 2, "not empty");
    refused("-o " + in, 2, "this is no folder");
    refused("-o out --parts vtu", 2, "");
    CHECK(folder.left().empty());
    const auto tiny = folder.input("tiny.off", tiny_triangles());
    const auto unclean = folder.run("volume " + tiny + " -o out --rounds 0");
    CHECK(unclean.status == 1);
    CHECK(contains(unclean.err, "nothing written"));
    CHECK(folder.left().empty());
}

TEST_CASE("cli: volume fills an empty folder", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", boxed_model);
    REQUIRE(folder.shell("mkdir out").status == 0);
    CHECK(folder.run("volume " + in + " -o out/").status == 0);
    CHECK(folder.shell("test -f out/model.json -a -f out/blocks/block_1.vtp").status == 0);
    CHECK(folder.left() == std::set<std::string>{"out"});
}

TEST_CASE("cli: volume: a block that only rounding made has the exact volume 0", "[cli]") {
    // f0 and f1 cross along an edge that ends at a third of no power of two. f2 ends at the doubles
    // nearest to that place, so the exact surfaces leave a gap, which rounding closes.
    const Folder folder;
    folder.input("made.obj", "v 7 5 1\nv 8 0 8\nv 6 0 2\nv 6 3 1\nv 1 7 3\n"
                             "v 6.169491525423729 2.7457627118644066 1.5932203389830508\n"
                             "o f0\nf 2 3 4\no f1\nf 1 3 5\no f2\nf 1 2 6\no f3\nf 1 2 3\n");
    const Outcome made = folder.run("volume in/made.obj -o out");
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "doubles: 1 block that the exact surfaces do not enclose"));
    const auto blocks = Json::parse(folder.read("out/model.json"))["blocks"];
    REQUIRE(blocks.size() == 2);
    CHECK_FALSE(blocks[0].contains("volume"));
    CHECK(blocks[1]["volume"] == 0.0); // null is not equal to it
    CHECK(blocks[1]["volume_written"] > 2);
}

TEST_CASE("cli: tables of relations and juxtapositions", "[cli]") {
    const Folder folder;
    const auto in =
        folder.input("model.obj", polygon("a,b \"quoted\"", "-1 -1 3, 4 -1 3, 4 9 3, -1 9 3") +
                                      polygon("fault", "4 -1 -1, 4 9 -1, 4 9 9, 4 -1 9"));
    const auto r = folder.run(
        "volume " + in + " -o model --box 0,0,0,8,8,8 --relations r.csv --juxtaposition j.csv");
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "wrote r.csv\n"));
    const auto relations = folder.read("r.csv");
    CHECK(relations.starts_with("surface,kind,other,length,least_gap,largest_gap,x,y,z\n"));
    CHECK(contains(relations, "\"a,b 'quoted'\",stops at,fault,8,,,4,"));
    const auto areas = folder.read("j.csv");
    CHECK(areas.starts_with("surface,block,name,other_block,other_name,area\n"));
    CHECK(contains(areas, "\"a,b 'quoted'\",1,"));
    CHECK(contains(areas, ",32\n"));
}

TEST_CASE("cli: volume: parts above contacts", "[cli]") {
    const Folder folder;
    const auto in =
        folder.input("cube.obj", cube) + " " + folder.input("level.obj", level("level", "3"));
    const auto made = folder.run("volume " + in +
                                 " -o model --contact 2 --contact 7.5 --contact 8 --stats s.json");
    CHECK(made.err == "");
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "above 2: volume 384 in 2 blocks\n"));
    CHECK(contains(made.out, "above 7.5: volume 32 in 1 block\n"));
    CHECK(contains(made.out, "above 8: volume 0 in 0 blocks\n"));
    const auto contacts = Json::parse(folder.read("s.json"))["contacts"];
    REQUIRE(contacts.size() == 3);
    REQUIRE(contacts[0]["blocks"].size() == 2); // one from 0 to 3, one from 3 to 8
    for (const auto& part : contacts[0]["blocks"]) {
        const bool lower = part["column"] == 1.0;
        CHECK(part["volume"] == (lower ? 64.0 : 320.0));
        CHECK(part["area"] == (lower ? 64.0 : 0.0));
        CHECK(part["column"] == (lower ? 1.0 : 6.0));
    }
    REQUIRE(contacts[1]["blocks"].size() == 1);
    CHECK(contacts[1]["blocks"][0]["area"] == 64.0);
    CHECK(contacts[1]["blocks"][0]["column"] == 0.5);
    CHECK(contacts[2]["blocks"].empty());
    const auto refused = folder.run("volume " + in + " --suggest-seal --contact 2");
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "--contact: needs a model, and --suggest-seal makes none"));
}
