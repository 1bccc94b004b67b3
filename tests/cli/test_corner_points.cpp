// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that the surfaces of a corner-point grid fit together: the blocks that they enclose are its
// layers between faults, and have the volume of its cells.
#include <numeric>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// A grid of 2 x 2 columns of 100 x 100 m with two layers of 50 m, whose east lies deeper by
/// `south` at y = 0 and by `north` at y = 200; the pillars lean by `lean` over 1000 m.
std::string faulted_grid(double south, double north, double lean) {
    std::string text = "SPECGRID\n2 2 2 1 F /\nCOORD\n";
    for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 2; ++i)
            text += fmt::format("{0} {1} 1000 {2} {1} 2000\n", 100 * i, 100 * j,
                                100 * i + lean * (1 + 0.3 * j));
    text += "/\nZCORN\n";
    for (const int level : {0, 1, 1, 2})
        for (const int y : {0, 1, 1, 2})
            for (const int side : {0, 0, 1, 1})
                text += fmt::format("{} ",
                                    1000 + 50 * level + side * (south + (north - south) * y / 2));
    return text + "\n/\n";
}

/// Returns the blocks without the outside.
std::vector<double> volumes_of_blocks(const std::string& grid) {
    const Folder folder;
    const auto made =
        folder.run("volume " + folder.input("grid.grdecl", grid) + " -o out --strict");
    INFO(made.err);
    REQUIRE(made.status == 0);
    const auto blocks = Json::parse(folder.read("out/model.json"))["blocks"];
    std::vector<double> volumes;
    for (std::size_t b = 1; b < blocks.size(); ++b) volumes.push_back(blocks[b]["volume"]);
    return volumes;
}

} // namespace

TEST_CASE("cli: blocks of a corner-point grid", "[cli][grdecl]") {
    struct Case {
        double south, north;
        std::size_t blocks;
    };
    for (const auto& [south, north, count] :
         {Case{0, 0, 2}, Case{30, 30, 4}, Case{0, 30, 4}, Case{70, 120, 4}, Case{-30, 30, 4}})
        for (const double lean : {0.0, 400.0}) {
            INFO(south << " " << north << " " << lean);
            const auto volumes = volumes_of_blocks(faulted_grid(south, north, lean));
            CHECK(volumes.size() == count);
            CHECK(std::accumulate(volumes.begin(), volumes.end(), 0.0) ==
                  Approx(4e6).epsilon(lean == 0 ? 1e-12 : 0.01));
        }
}
