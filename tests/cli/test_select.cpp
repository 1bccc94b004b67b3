// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane select`.
#include <array>
#include <cstddef>
#include <cstdio>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Returns a box from (low, low, low) to (high, high, high) that faces outwards.
std::string box(const std::string& name, int low, int high) {
    std::string text = "o " + name + "\n";
    for (unsigned corner = 0; corner < 8; ++corner) {
        text += "v";
        for (unsigned axis = 0; axis < 3; ++axis)
            text += " " + std::to_string((corner >> axis & 1U) != 0 ? high : low);
        text += "\n";
    }
    return text + "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\n"
                  "f -8 -4 -2 -6\nf -7 -5 -1 -3\n";
}

/// Two boxes that overlap in a unit cube.
std::string two_boxes() {
    return box("a", 0, 2) + box("b", 1, 4);
}

/// Returns tetrahedra of the surfaces a and b, so small, compared with their coordinates, that the nearest doubles
/// of their crossings are no conforming mesh.
std::string tiny_tetrahedra() {
    std::string text;
    unsigned state = 7;
    const auto next = [&] {
        state = state * 1103515245U + 12345U;
        return static_cast<int>((state >> 16U) % 64U);
    };
    for (unsigned k = 0; k < 8; ++k) {
        text += k % 2 == 0 ? "o a\n" : "o b\n";
        for (unsigned v = 0; v < 4; ++v) {
            text += "v";
            for (unsigned axis = 0; axis < 3; ++axis) {
                char word[64];
                std::snprintf(word, sizeof word, " %.17g", 70368744177664 + next() / 64.0);
                text += word;
            }
            text += "\n";
        }
        text += "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n";
    }
    return text;
}

/// Returns the volume within the triangles of an OBJ; it is positive if they face outwards.
double volume_in(const std::string& obj) {
    std::vector<std::array<double, 3>> points;
    std::istringstream in(obj);
    double sum = 0;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line.substr(1));
        if (std::array<double, 3> p{}; line[0] == 'v' && words >> p[0] >> p[1] >> p[2])
            points.push_back(p);
        std::size_t i = 0, j = 0, k = 0;
        if (line[0] != 'f' || !(words >> i >> j >> k)) continue;
        const auto &a = points[i - 1], &b = points[j - 1], &c = points[k - 1];
        for (unsigned x = 0; x < 3; ++x) {
            const unsigned y = (x + 1) % 3, z = (x + 2) % 3;
            sum += a[x] * (b[y] * c[z] - b[z] * c[y]);
        }
    }
    return sum / 6;
}

} // namespace

TEST_CASE("cli: select gives the volumes of two boxes", "[cli]") {
    const Folder folder;
    const auto in = folder.input("two.obj", two_boxes());
    struct Case {
        std::string expression, volume;
        std::size_t pieces, cavities;
    };
    for (const Case& c :
         {Case{"a | b", "34", 1, 0}, Case{"a & b", "1", 1, 0}, Case{"a - b", "7", 1, 0},
          Case{"b - a", "26", 1, 0}, Case{"a ^ b", "33", 2, 1}, Case{"(a | b) - b", "7", 1, 0}}) {
        INFO(c.expression);
        const auto r = folder.run("select '" + c.expression + "' " + in +
                                  " -o out.obj --fractions --stats s.json");
        INFO(r.err);
        REQUIRE(r.status == 0);
        CHECK(contains(r.out, "volume " + c.volume + ", exactly " + c.volume + "\n"));
        CHECK(contains(r.out, "verified: "));
        CHECK(contains(r.out, "wrote out.obj\n"));
        const auto region = Json::parse(folder.read("s.json"))["region"];
        CHECK(region["exact_volume"] == c.volume);
        CHECK(region["volume"] == std::stod(c.volume));
        CHECK(region["pieces"].size() == c.pieces);
        CHECK(region["cavities"] == c.cavities);
        CHECK(folder.run("check out.obj").status == 0);
        CHECK(volume_in(folder.read("out.obj")) == std::stod(c.volume));
    }
}

TEST_CASE("cli: select lists pieces, and writes to standard output", "[cli]") {
    const Folder folder;
    const auto in = folder.input("two.obj", box("a", 0, 1) + box("b", 2, 4));
    const auto r = folder.run("select 'a | b' " + in + " -o - --output-format obj --quiet");
    CHECK(r.status == 0);
    CHECK(contains(r.out, "g a\n"));
    CHECK(r.err.empty());
    const auto told = folder.run("select 'a | b' " + in + " -o out.vtp");
    CHECK(contains(told.out, "region: 24 triangles, 2 pieces, 0 cavities, volume 9\n"
                             "  piece 1: 12 triangles, volume 1\n"
                             "  piece 2: 12 triangles, volume 8\n"));
}

TEST_CASE("cli: select divides bodies by open surfaces, and cuts these", "[cli]") {
    const Folder folder;
    const auto in = folder.input("two.obj", two_boxes());
    const auto plane =
        folder.input("plane.obj", polygon("plane", "-9 -9 1, 9 -9 1, 9 9 1, -9 9 1"));
    const auto both = in + " " + plane;
    const auto below = folder.run("select 'a & below(plane)' " + both + " -o out.obj --fractions");
    CHECK(below.status == 0);
    CHECK(contains(below.out, "volume 4, exactly 4\n"));
    const auto part =
        folder.run("select 'plane & inside(a)' " + both + " -o out.obj --stats s.json");
    CHECK(part.status == 0);
    CHECK(contains(part.out, "1 region\n"));
    CHECK(Json::parse(folder.read("s.json"))["region"]["regions"] == 1);
    const auto none = folder.run("select 'plane & above(plane)' " + both + " -o none.obj");
    CHECK(none.status == 1);
    CHECK(contains(none.out, "surface: nothing of it is left\n"));
    const auto refused = folder.run("select 'a & plane' " + both + " -o none.obj");
    CHECK(refused.status == 1);
    CHECK(contains(refused.err, "plane: bounds no solid: it is not closed along "));
}

TEST_CASE("cli: select --split writes each piece to a file of its own", "[cli]") {
    const Folder folder;
    const auto in = folder.input("two.obj", two_boxes());
    const auto r = folder.run("select 'a ^ b' " + in + " -o out.obj --split");
    CHECK(r.status == 0);
    CHECK(contains(r.out, "wrote out-1.obj\nwrote out-2.obj\n"));
    CHECK(volume_in(folder.read("out-1.obj")) == 7);
    CHECK(volume_in(folder.read("out-2.obj")) == 26);
    const auto refused = folder.run("select 'a ^ b' " + in + " -o - --output-format obj --split");
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "--split: takes the name of a file"));
}

TEST_CASE("cli: select takes --rule for what is inside", "[cli]") {
    const Folder folder;
    const auto in = folder.input("shells.obj", box("a", 0, 4) + box("a", 1, 3));
    const auto volume = [&](const std::string& rule) {
        return folder.run("select a " + in + " -o out.obj --rule " + rule).out;
    };
    CHECK(contains(volume("nonzero"), "0 cavities, volume 64\n"));
    CHECK(contains(volume("odd"), "1 cavity, volume 56\n"));
    CHECK(folder.run("select a " + in + " -o out.obj --rule even").status == 2);
}

TEST_CASE("cli: select names mistakes with their places", "[cli]") {
    const Folder folder;
    const auto in = folder.input("two.obj", two_boxes());
    const auto open = folder.input("open.obj", polygon("open", "9 9 9, 10 9 9, 9 10 9"));
    const auto refused = [&](const std::string& arguments, const std::string& why, int status = 2) {
        const auto r = folder.run("select " + arguments + " -o out.obj");
        INFO(r.err);
        CHECK(r.status == status);
        CHECK(contains(r.err, why));
        CHECK(folder.left().empty());
    };
    refused("'a + b' " + in, "expression, column 3: expected an operator");
    refused("'a - c' " + in, "no surface is called c");
    refused("'~a' " + in, "the region has no end");
    refused("'a - open' " + in + " " + open,
            "open: bounds no solid: it is not closed along 3 edges, first at (9, 9, 9)", 1);
    refused("'' " + in, "EXPRESSION: the value is empty");
    refused("nan " + in, "no surface is called nan");
}

TEST_CASE("cli: select writes nothing that is not conforming in doubles", "[cli]") {
    const Folder folder;
    const auto in = folder.input("tiny.obj", tiny_tetrahedra());
    const auto select = [&](const std::string& options) {
        return folder.run("select 'a | b' " + in + " -o out.obj " + options);
    };
    const auto short_of = select("--max-move 1e-9");
    CHECK(short_of.status == 2);
    CHECK(contains(short_of.err, "terrane: --max-move: "));
    const auto r = select("--max-move 0.02 --stats s.json");
    INFO(r.out << r.err);
    CHECK(r.status == 1);
    CHECK(contains(r.out, "region: 1 piece, "));
    CHECK(contains(r.out, "NOT verified: "));
    CHECK(contains(r.err, "  crossing at (70368744177664."));
    CHECK(contains(r.err, "nothing written"));
    CHECK(folder.left() == std::set<std::string>{"s.json"});
    CHECK(Json::parse(folder.read("s.json"))["region"]["volume"].get<double>() > 0);
    CHECK(select("").status == 0);
}

TEST_CASE("cli: select writes nothing of an empty region", "[cli]") {
    const Folder folder;
    const auto in = folder.input("two.obj", two_boxes());
    const auto r = folder.run("select 'a - (a | b)' " + in + " -o out.obj");
    CHECK(r.status == 1);
    CHECK(r.out == "region: empty\n");
    CHECK(contains(r.err, "nothing written"));
    CHECK(folder.left().empty());
}
