// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A block has the same number in all outputs, also where rounding loses another block.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Three planes that almost meet in one line: the prism between them is far thinner than the
/// spacing of doubles there, and rounding makes the planes meet in the line x = y = 4.
const std::string planes = polygon("first", "-1 -1 -1, 9 9 -1, 9 9 9, -1 -1 9") +
                           polygon("second", "-1 9 -1, 9 -1 -1, 9 -1 9, -1 9 9") +
                           polygon("third", "4.0000000000000009 -60 -1, 3.9999999999999991 72 -1, "
                                            "3.9999999999999991 72 9, 4.0000000000000009 -60 9");

constexpr std::size_t lost = 5; ///< the number of the prism: there are blocks after it

struct Block {
    std::string name;
    double volume = 0; ///< as the file states it
    bool operator==(const Block& b) const { return name == b.name && volume == b.volume; }
};

std::ostream& operator<<(std::ostream& out, const Block& b) {
    return out << b.name << " " << b.volume;
}

/// Returns the blocks in model.json, by number.
std::vector<Block> blocks_of(const std::string& model) {
    std::vector<Block> blocks;
    const auto json = Json::parse(model);
    for (const auto& block : json["blocks"])
        blocks.push_back({block["name"], block.value("volume_written", 0.0)});
    return blocks;
}

#ifdef TERRANE_HAS_TETGEN
/// Returns the names of blocks in an MSH file, by number, with their volumes from the statistics.
std::vector<Block> blocks_in(const std::string& msh, const Json& statistics) {
    std::vector<Block> blocks;
    const auto& volumes = statistics["tetrahedra"]["volume_of_block"];
    for (std::size_t r = 0; r < volumes.size(); ++r) {
        const auto start = "\"block " + std::to_string(r) + ": ";
        const auto at = msh.find(start);
        const auto name_at = at + start.size();
        blocks.push_back({at == std::string::npos
                              ? std::string()
                              : msh.substr(name_at, msh.find('"', name_at) - name_at),
                          volumes[r]});
    }
    return blocks;
}
#endif

Json project() {
    return Json::parse(R"({
        "format": "terrane-project 1",
        "surfaces": [{"file": "planes.obj", "role": "fault"}],
        "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}},
        "outputs": {"blocks": "obj"}})");
}

} // namespace

TEST_CASE("cli: blocks keep their numbers where rounding loses one of them", "[cli][once]") {
    const Folder folder;
    const auto in = folder.input("planes.obj", planes);
    const auto volume = folder.run("volume " + in + " -o volume --parts obj --box 0,0,0,8,8,8 " +
                                   "--role first=fault --role second=fault --role third=fault");
    INFO(volume.err);
    REQUIRE(volume.status == 0);
    CHECK(contains(volume.out, "  block 5    volume 5.79512e-33      (too thin for doubles)\n"));
    const auto blocks = blocks_of(folder.read("volume/model.json"));
    REQUIRE(blocks.size() == 8);
    CHECK(blocks[lost].volume == 0);
    CHECK(blocks[lost + 1].volume == 128);
    CHECK(blocks[lost + 2].volume == 64);

    const auto build = [&](const Json& json, const std::string& to) {
        const auto r = folder.run("build " + folder.input("p.json", json.dump()) + " -o " + to);
        INFO(r.err);
        REQUIRE(r.status == 0);
        return Json::parse(folder.read(to + "/statistics.json"));
    };
    auto json = project();
    build(json, "plain");
    CHECK(folder.read("plain/model/model.json") == folder.read("volume/model.json"));
    json["improve"] = {{"edge_length", 2}};
    const auto improved = build(json, "improved");
    CHECK(improved["volumes"]["too_thin"] == 1);
    CHECK(blocks_of(folder.read("improved/model/model.json")) == blocks);

#ifdef TERRANE_HAS_TETGEN
    json["outputs"]["tetrahedra"] = {"msh"};
    const auto filled_again = build(json, "filled_improved");
    json.erase("improve");
    const auto filled = build(json, "filled");
    const auto r =
        folder.run("tetrahedralize " + in + " -o t.msh --box 0,0,0,8,8,8 --stats t.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    const auto by_command = blocks_in(folder.read("t.msh"), Json::parse(folder.read("t.json")));
    const auto by_build = blocks_in(folder.read("filled/tetrahedra.msh"), filled);
    const auto by_both = blocks_in(folder.read("filled_improved/tetrahedra.msh"), filled_again);
    REQUIRE(by_command.size() == 8);
    REQUIRE(by_build.size() == 8);
    REQUIRE(by_both.size() == 8);
    for (std::size_t b = 1; b < 8; ++b) {
        const Block expected = b == lost ? Block{} : blocks[b];
        CHECK(by_command[b] == expected);
        CHECK(by_build[b] == expected);
        CHECK(by_both[b].name == expected.name);
        CHECK(by_both[b].volume == Approx(expected.volume));
    }
    // A block that rounding lost can't have a size; the one after it can, by its number.
    json["tetrahedra"] = Json::parse(R"({"size_in": {"5": 1}})");
    const auto refused = folder.run("build " + folder.input("p.json", json.dump()) + " -o refused");
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "tetrahedra.size_in.5: block 5 is too thin for doubles"));
    json["tetrahedra"] = Json::parse(R"({"size_in": {"6": 1}})");
    const auto fine = build(json, "fine")["tetrahedra"]["tetrahedra_of_block"];
    // A size is a bound on volumes, that of a regular tetrahedron, which is exceeded by a fifth at
    // most (docs/how-to/tetrahedra.md). So block 6 has this number of tetrahedra at least, which it
    // has not without the size.
    const double least = blocks[6].volume / (1.2 / (6 * std::sqrt(2.0)));
    CHECK(double(fine[6]) >= least);
    CHECK(double(filled["tetrahedra"]["tetrahedra_of_block"][6]) < least);
#endif
}
