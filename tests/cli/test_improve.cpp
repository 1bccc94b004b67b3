// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

TEST_CASE("cli: improve writes a conforming mesh, its statistics and histograms", "[cli]") {
    const Folder folder;
    folder.input("two.obj", crossing);
    const Outcome made = folder.run("improve in/two.obj -o out.obj -o out.vtp --edge-length 0.5 "
                                    "--histogram q.svg --stats s.json");
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "verified: the improved mesh is conforming, by exact check"));
    CHECK(folder.run("check out.obj").status == 0);
    const Json stats = Json::parse(folder.read("s.json"));
    const auto& after = stats.at("quality").at("after");
    CHECK(after.at("q").at("mean") > stats.at("quality").at("before").at("q").at("mean"));
    CHECK(after.at("triangles") == stats.at("output").at("triangles"));
    std::size_t counted = 0;
    for (const std::size_t n : after.at("histogram")) counted += n;
    CHECK(counted == after.at("triangles"));
    CHECK(stats.at("deviation").at("measured_of_surfaces").at(0) <=
          stats.at("deviation").at("bound_of_surfaces").at(0));
    for (std::size_t s = 0; s < 2; ++s) {
        const auto& deviation = stats.at("deviation");
        CHECK(deviation.at("bound_back_of_surfaces").at(s) <=
              deviation.at("bound_of_surfaces").at(s));
        CHECK(deviation.at("measured_back").at(s) <= deviation.at("bound_back_of_surfaces").at(s));
    }
    const std::string svg = folder.read("q.svg");
    CHECK(svg.starts_with("<svg "));
    CHECK(svg.ends_with("</svg>\n"));
    CHECK(contains(svg, "after: " + std::to_string(after.at("triangles").get<int>())));
}

TEST_CASE("cli: improve writes a certificate that verify takes", "[cli][once]") {
    const Folder folder;
    folder.input("two.obj", crossing);
    REQUIRE(folder
                .run("improve in/two.obj -o out.obj -o out.vtp --edge-length 0.5 "
                     "--max-deviation 0.02 --certificate c.json")
                .status == 0);
    const Outcome valid = folder.run("verify c.json");
    INFO(valid.out << valid.err);
    CHECK(valid.status == 0);
    CHECK(contains(valid.out, "improved: "));
    CHECK(contains(valid.out, "at most 0.02 away, both ways"));
    CHECK(contains(valid.out, "out.vtp: holds these triangles: every byte"));
    const Json verdict = Json::parse(folder.run("verify c.json --json").out);
    CHECK(verdict.at("change") == 0.02);
    CHECK(folder.run("verify c.json --max-change 0.01").status == 1);
    CHECK(folder.run("verify c.json --output in/two.obj").status == 1);
}

TEST_CASE("cli: improve refuses what makes no sense, and writes nothing", "[cli]") {
    const Folder folder;
    folder.input("two.obj", crossing);
    for (const std::string options :
         {"--edge-length -1", "--edge-length 1x", "--edge-length nan", "--edge-length-of fault",
          "--edge-length-of nobody=1", "--edge-length-of fault=0", "--passes 0", "--turn -5",
          "--max-deviation 1e-300", "--max-deviation 0", "--curve-length 0", "--turn 0",
          "--thickness-share 0", "--least-quality 0", "--least-quality 1.1",
          "--max-volume-change -1", "--edge-length 1e-6", "--edge-length 0.5 --max-triangles 10",
          "--histogram nowhere/q.svg"}) {
        const Outcome made = folder.run("improve in/two.obj -o out.obj " + options);
        INFO(options << ": " << made.err);
        CHECK(made.status == 2);
        CHECK_FALSE(made.err.empty());
    }
    CHECK(folder.left().empty());
}

TEST_CASE("cli: improve states the volumes of blocks, and judges how they change", "[cli][once]") {
    const Folder folder;
    const std::string thin = "improve $D/improve/thin_block.obj --edge-length 150 ";
    const Outcome kept = folder.run(thin + "-o kept.obj --stats kept.json --max-volume-change 20");
    INFO(kept.err);
    REQUIRE(kept.status == 0);
    CHECK(contains(kept.out, "volumes: "));
    CHECK_FALSE(contains(kept.err, "the volume of a block changed"));
    const Json stats = Json::parse(folder.read("kept.json"));
    CHECK(stats.at("improve").at("thin_triangles") > 0);
    const auto& blocks = stats.at("improve").at("blocks");
    REQUIRE_FALSE(blocks.empty());
    for (const auto& b : blocks) CHECK(b.at("change_percent") < 20);

    const Outcome held =
        folder.run(thin + "-o held.obj --stats held.json --thickness-share 1e6 --strict");
    CHECK(held.status == 0);
    const Json now = Json::parse(folder.read("held.json")).at("improve");
    CHECK(now.at("held_blocks") > 0);
    for (const auto& b : now.at("blocks")) CHECK(b.at("change_percent") <= 5);

    // At these coordinates no smaller deviation can be told from rounding errors.
    const std::string large = "improve $D/improve/large_h0.obj $D/improve/large_h1.obj "
                              "$D/improve/large_h2.obj $D/improve/large_f0.obj "
                              "--max-volume-change 1e-6 ";
    const Outcome loose = folder.run(large + "-o loose.obj");
    CHECK(loose.status == 0);
    CHECK(contains(loose.err, "the volume of a block changed by "));
    const Outcome strict = folder.run(large + "-o strict.obj --strict");
    CHECK(strict.status == 1);
    CHECK(contains(strict.err, "nothing written"));
    const auto left = folder.left();
    CHECK(std::find(left.begin(), left.end(), "strict.obj") == left.end());
}

TEST_CASE("cli: improve writes the same bytes for any number of threads", "[cli]") {
    const Folder folder;
    const std::string model = "improve $D/ringmesh/split_cube.ml --edge-length 0.2 -o ";
    REQUIRE(folder.run(model + "one.obj --threads 1").status == 0);
    REQUIRE(folder.run(model + "four.obj --threads 4").status == 0);
    CHECK(folder.read("one.obj") == folder.read("four.obj"));
}

TEST_CASE("cli: improve needs a conforming mesh", "[cli]") {
    const Folder folder;
    folder.input("tiny.off", tiny_triangles());
    const Outcome made = folder.run("improve in/tiny.off -o out.obj --rounds 0");
    CHECK(made.status == 1);
    CHECK(contains(made.err, "the doubles are not a conforming mesh"));
    CHECK(folder.left().empty());
}
