// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane arrange --memory` from outside, where doubles need repair.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

TEST_CASE("cli: arrange --memory repairs doubles as arrange does, near what is in the way",
          "[cli]") {
    const Folder folder;
    for (const std::string name : {"needle_tip", "turned_ridges"}) {
        CAPTURE(name);
        const auto in = " \"$D/../certified/" + name + "/input.obj\" ";
        const auto r = folder.run("arrange" + in + "-o m.vtp --memory 8KiB --stats s.json");
        INFO(r.err);
        REQUIRE(r.status == 0);
        CHECK(contains(r.out, name == "needle_tip" ? "doubles: triangles without area dropped; "
                                                   : "in the way repaired, in "));
        const auto stats = Json::parse(folder.read("s.json"));
        CHECK(stats["blocks"] > 2);
        CHECK(stats["rounding"]["in_blocks"] == true);
        CHECK(stats["rounding"]["gathered_triangles"] > 0);
        REQUIRE(folder.run("arrange" + in + "-o whole.vtp").status == 0);
        CHECK(folder.read("m.vtp") == folder.read("whole.vtp"));
    }
}

TEST_CASE("cli: arrange --memory moves the input only if the whole model fits", "[cli]") {
    const Folder folder;
    const std::string arrange = "arrange \"$D/../certified/turned_grids/input.obj\" ";
    const auto refused = folder.run(arrange + "-o m.vtp --memory 8KiB");
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "in the way), and a repair needs the whole model in memory: 0.0"));
    CHECK(folder.left().empty());

    REQUIRE(folder.run(arrange + "-o whole.vtp").status == 0);
    const auto r = folder.run(arrange + "-o m.vtp -o m.pvtp --memory 1MiB --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "doubles: repaired in one process, in "));
    const auto stats = Json::parse(folder.read("s.json"));
    CHECK(stats["rounding"]["in_blocks"] == false);
    CHECK(folder.read("m.vtp") == folder.read("whole.vtp"));
    REQUIRE(folder.run("convert m.pvtp joined.vtp").status == 0);
    CHECK(folder.read("joined.vtp") == folder.read("whole.vtp"));

    REQUIRE(folder.run(arrange + "-o v.vtp --memory 1MiB --volumes --stats v.json").status == 0);
    CHECK(Json::parse(folder.read("v.json"))["volumes"]["names"] == Json::array({"outside"}));
    CHECK(contains(folder.read("v.vtp"), "volume_front"));
}
