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
        CHECK(contains(r.out, "in the way repaired, in "));
        const auto stats = Json::parse(folder.read("s.json"));
        CHECK(stats["blocks"] > 2);
        CHECK(stats["rounding"]["in_blocks"] == true);
        CHECK(stats["rounding"]["gathered_triangles"] > 0);
        REQUIRE(folder.run("arrange" + in + "-o whole.vtp").status == 0);
        CHECK(folder.read("m.vtp") == folder.read("whole.vtp"));
    }
}

TEST_CASE("cli: arrange --memory refuses what takes a moved input", "[cli]") {
    const Folder folder;
    const auto r =
        folder.run("arrange \"$D/../certified/utm_millimetres/input.obj\" -o m.vtp --memory 8KiB");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "in the way), and a repair needs the whole model in memory"));
    CHECK(folder.left().empty());
}
