// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane arrange --memory` from outside, where doubles need repair.
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Two sheets of n x n squares in one inclined plane, by half a square apart.
std::string turned_sheets(int n) {
    std::string text;
    for (const double shift : {0.0, 0.5})
        for (int i = 0; i <= n; ++i)
            for (int k = 0; k <= n; ++k) {
                const double x = (i + shift) / n, y = (k + shift) / n;
                text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", 0.8 * x - 0.36 * y,
                                    0.8 * y + 0.1, -0.6 * x - 0.48 * y);
            }
    for (const int first : {1, 1 + (n + 1) * (n + 1)}) {
        text += fmt::format("g sheet{}\n", first);
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < n; ++k) {
                const int a = first + i * (n + 1) + k, b = a + n + 1;
                text += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
            }
    }
    return text;
}

} // namespace

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
        CHECK(stats["tiles"] > 2);
        CHECK(stats["rounding"]["in_tiles"] == true);
        CHECK(stats["rounding"]["gathered_triangles"] > 0);
        REQUIRE(folder.run("arrange" + in + "-o whole.vtp").status == 0);
        CHECK(folder.read("m.vtp") == folder.read("whole.vtp"));
    }
}

TEST_CASE("cli: arrange --memory moves the input", "[cli]") {
    const Folder folder;
    for (const std::string name : {"turned_grids", "close_angle_turned"}) {
        CAPTURE(name);
        const auto in = " \"$D/../certified/" + name + "/input.obj\" ";
        const auto r = folder.run("arrange" + in + "-o m.vtp --memory 8KiB --stats s.json");
        INFO(r.err);
        REQUIRE(r.status == 0);
        CHECK(contains(r.out, "; the input was moved and arranged again, in "));
        const auto stats = Json::parse(folder.read("s.json"));
        CHECK(stats["rounding"]["in_tiles"] == true);
        CHECK(stats["rounding"]["arranged_again"] == true);
        REQUIRE(folder.run("arrange" + in + "-o whole.vtp").status == 0);
        CHECK(folder.read("m.vtp") == folder.read("whole.vtp"));
    }
}

TEST_CASE("cli: arrange --memory rounds the whole model only if it fits", "[cli][once]") {
    const Folder folder;
    const std::string comment(4'000'000, '#'); // for more tiles
    const auto arrange = "arrange " + folder.input("in.obj", turned_sheets(72) + comment) + " ";
    const auto refused = folder.run(arrange + "-o m.vtp --memory 4MiB");
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "in the way), and a repair needs the whole model in memory: 0.1"));
    CHECK(folder.left().empty());

    REQUIRE(folder.run(arrange + "-o whole.vtp").status == 0);
    const auto r = folder.run(arrange + "-o m.vtp -o m.pvtp --memory 90MiB --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "doubles: repaired in one process, in "));
    const auto stats = Json::parse(folder.read("s.json"));
    CHECK(stats["rounding"]["in_tiles"] == false);
    CHECK(folder.read("m.vtp") == folder.read("whole.vtp"));
    REQUIRE(folder.run("convert m.pvtp joined.vtp").status == 0);
    CHECK(folder.read("joined.vtp") == folder.read("whole.vtp"));

    REQUIRE(folder.run(arrange + "-o v.vtp --memory 90MiB --volumes --stats v.json").status == 0);
    CHECK(Json::parse(folder.read("v.json"))["volumes"]["names"] == Json::array());
    CHECK(contains(folder.read("v.vtp"), "volume_front"));
}
