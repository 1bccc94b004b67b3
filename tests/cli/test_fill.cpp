// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane fill` and the readers of grids and points from outside.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "holed_fold.hpp"
#include "program.hpp"

using namespace program_test;

namespace {

double wave(double x, double y) {
    return 15 * std::sin(x / 60) * std::cos(y / 80) + 0.1 * x;
}

/// Returns an Irap grid of 24 x 24 depths, 10 apart, without the nodes in `left_out`.
std::string irap(const std::function<bool(int, int)>& left_out,
                 const std::function<double(double, double)>& z = wave) {
    std::string text = "-996 24 10 10\n0 230 0 230\n24 0 0 0\n0 0 0 0 0 0 0\n";
    for (int j = 0; j < 24; ++j)
        for (int i = 0; i < 24; ++i)
            text += left_out(i, j) ? "9999900 " : std::to_string(-z(10.0 * i, 10.0 * j)) + "\n";
    return text;
}

bool two_discs(int i, int j) {
    return std::hypot(i - 7, j - 8) < 2.5 || std::hypot(i - 16, j - 15) < 4.2;
}

/// Returns a surface with a tear, one side of which is lifted.
std::string torn() {
    const auto left_out = [](int i, int j) { return i == 12 && j > 4 && j < 18; };
    return irap(left_out,
                [](double x, double y) { return x > 120 && y > 45 && y < 175 ? 60.0 : 0.0; });
}

/// Returns the largest difference between z and the true height among the vertices of an OBJ.
double largest_error(const std::string& obj) {
    double largest = 0;
    std::istringstream in(obj);
    std::string word;
    while (in >> word)
        if (double x = 0, y = 0, z = 0; word == "v" && in >> x >> y >> z)
            largest = std::max(largest, std::abs(z - wave(x, y)));
    return largest;
}

} // namespace

TEST_CASE("cli: convert reads a grid with its holes, depth or elevation", "[cli]") {
    const Folder folder;
    const auto in = folder.input("top.irap", irap(two_discs));
    REQUIRE(folder.run("convert --depth " + in + " out.obj").status == 0);
    CHECK(largest_error(folder.read("out.obj")) < 1e-5);
    CHECK(folder.run("convert " + in + " down.obj").status == 0);
    CHECK(largest_error(folder.read("down.obj")) > 1);
    const auto as_text = folder.input("top.txt", irap(two_discs));
    CHECK(folder.run("convert --depth --input-format irap " + as_text + " again.obj").status == 0);
    CHECK(folder.read("again.obj") == folder.read("out.obj"));
    const auto wrong = folder.run("convert --input-format grid " + as_text + " no.obj");
    CHECK(wrong.status == 2);
    CHECK(contains(wrong.err, "unknown format grid"));
    const auto out = folder.run("convert " + in + " out.irap");
    CHECK(out.status == 2);
    CHECK(contains(out.err, "this format is for grids, which terrane map writes"));
    CHECK(folder.run("check --depth " + in).status == 0);
    // A certificate is about files as they were read.
    REQUIRE(
        folder.run("arrange --depth " + in + " -o arranged.obj --certificate proof.json").status ==
        0);
    CHECK(folder.run("verify --depth proof.json").status == 0);
    CHECK(folder.run("verify proof.json").status == 1);
}

TEST_CASE("cli: fill lists holes, by numbers, and writes nothing then", "[cli]") {
    const Folder folder;
    const auto in = folder.input("top.irap", irap(two_discs));
    const auto r = folder.run("fill " + in + " --list --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "top: 1 outer border, 2 holes, 0 fault gaps\n"));
    CHECK(folder.left() == std::set<std::string>{"s.json"});
    const auto holes = Json::parse(folder.read("s.json"))["holes"];
    REQUIRE(holes.size() == 2);
    CHECK(holes[0]["hole"] == 1);
    CHECK(holes[0]["area"].get<double>() > holes[1]["area"].get<double>());
    CHECK(holes[0]["kind"] == "hole");
}

TEST_CASE("cli: fill writes a certificate that verify takes", "[cli][once]") {
    const Folder folder;
    const auto in = folder.input("top.irap", irap(two_discs));
    for (const std::string method : {"kriging", "rbf"}) {
        REQUIRE(folder
                    .run("fill --depth " + in + " -o out.obj -o out.vtp --certificate c.json " +
                         "--method " + method)
                    .status == 0);
        const Outcome valid = folder.run("verify --depth c.json");
        INFO(valid.out << valid.err);
        CHECK(valid.status == 0);
        CHECK(contains(valid.out, "given and kept"));
        CHECK(contains(valid.out, "out.vtp: holds these triangles: every byte"));
        CHECK(folder.run("verify c.json").status == 1); // heights, not depths
    }
    CHECK(folder.run("fill --depth " + in + " -o x.obj --certificate -").status == 2);
}

TEST_CASE("cli: fill by kriging and by RBF, with a map, points and a report", "[cli]") {
    for (const std::string method : {"kriging", "rbf"}) {
        const Folder folder;
        const auto in = folder.input("top.irap", irap(two_discs));
        const auto r = folder.run("fill --depth " + in + " -o out.obj -o out.vtp --method " +
                                  method + " --map m.svg --points p.csv --stats s.json");
        INFO(r.err);
        REQUIRE(r.status == 0);
        CHECK(contains(r.out, "filled 2 of 2 holes: "));
        CHECK(largest_error(folder.read("out.obj")) < 0.1);
        CHECK(contains(folder.read("out.vtp"), "Name=\"interpolated\""));
        CHECK(contains(folder.read("out.vtp"), "Name=\"deviation\""));
        CHECK(folder.read("m.svg").starts_with("<svg"));
        CHECK(folder.read("p.csv").starts_with("x,y,z,deviation,variance,surface\n"));
        const auto holes = Json::parse(folder.read("s.json"))["holes"];
        std::size_t interpolated = 0;
        for (const auto& hole : holes)
            interpolated += hole["filled"]["interpolated"].get<std::size_t>();
        const auto csv = folder.read("p.csv");
        CHECK(std::size_t(std::count(csv.begin(), csv.end(), '\n')) == interpolated + 1);
        CHECK(folder.run("check out.obj").status == 0);
        const auto after = folder.run("fill out.obj --list");
        CHECK(contains(after.out, "1 outer border, 0 holes"));
    }
}

TEST_CASE("cli: fill foresees its errors, and smooths on request", "[cli][once]") {
    const Folder folder;
    const auto noisy = [](double x, double y) { // no two nodes have much in common
        const double hash = std::sin(12.9898 * x + 78.233 * y) * 43758.5453;
        return wave(x, y) + 1.6 * (hash - std::floor(hash) - 0.5);
    };
    const auto in = folder.input("top.irap", irap(two_discs, noisy));
    for (const std::string smoothing : {"none", "auto", "3"}) {
        const auto r =
            folder.run("fill --depth " + in + " -o " + smoothing +
                       ".obj --method rbf --points p.csv --stats s.json --smoothing " + smoothing);
        INFO(r.err);
        REQUIRE(r.status == 0);
        const auto holes = Json::parse(folder.read("s.json"))["holes"];
        for (const auto& hole : holes) {
            CHECK(hole["filled"]["expected_error"].get<double>() > 0);
            double weight = 0;
            for (const auto& model : hole["filled"]["models"]) {
                const auto text = model["model"].get<std::string>();
                const bool told = contains(text, "nugget 9") || contains(text, "noise 3");
                CHECK(told == (smoothing == "3"));
                CHECK(model["deviation"].get<double>() > 0);
                weight += model["weight"].get<double>();
            }
            CHECK(weight == Approx(1));
        }
        std::istringstream csv(folder.read("p.csv"));
        std::string line;
        std::getline(csv, line);
        while (std::getline(csv, line)) CHECK_FALSE(contains(line, ",,"));
    }
    // The noise that the data of a graph show stays out of the hole in any case.
    CHECK(folder.read("none.obj") == folder.read("auto.obj"));
    CHECK(folder.read("auto.obj") != folder.read("3.obj"));
    for (const std::string wrong : {"--method rbf --smoothing much", "--method rbf --smoothing 0",
                                    "--method rbf --smoothing -1", "--smoothing auto"}) {
        const auto r = folder.run("fill " + in + " -o no.obj " + wrong);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "--smoothing: "));
    }
    for (const std::string option : {"--rings", "--isotropic", "--model"}) {
        const std::string value = option == "--rings" ? " 3" : option == "--model" ? " matern" : "";
        const auto r = folder.run("fill " + in + " -o no.obj --method rbf " + option + value);
        CHECK(r.status == 2);
        CHECK(contains(r.err, option + ": is of --method kriging"));
    }
    CHECK_FALSE(folder.left().contains("no.obj"));
}

TEST_CASE("cli: fill leaves what was not asked for: numbers, sizes, fault gaps", "[cli]") {
    const Folder folder;
    const auto in = folder.input("top.irap", irap(two_discs));
    CHECK(contains(folder.run("fill " + in + " -o a.obj --holes 2").out, "filled 1 of 2 holes"));
    CHECK(contains(folder.run("fill a.obj --list").out, "1 hole,"));
    CHECK(contains(folder.run("fill " + in + " -o b.obj --max-area 3000").out,
                   "filled 1 of 2 holes"));
    for (const std::string list : {"3", "0", "x", "1,,2", "1x"}) {
        const auto r = folder.run("fill " + in + " -o c.obj --holes " + list);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "--holes: "));
    }
    const auto tear = folder.input("tear.irap", torn());
    const auto left = folder.run("fill --depth " + tear + " -o d.obj");
    CHECK(left.status == 0);
    CHECK(contains(left.out, "0 holes, 1 fault gap"));
    CHECK(contains(left.out, "filled 0 of 1 hole"));
    CHECK(contains(folder.run("fill --depth --bridge-faults " + tear + " -o e.obj").out,
                   "filled 1 of 1 hole"));
    CHECK(folder.run("fill " + in).status == 2); // neither -o nor --list is given
    CHECK(folder.left() == std::set<std::string>{"a.obj", "b.obj", "d.obj", "e.obj"});
}

TEST_CASE("cli: fill names holes that kriging can't fill, leaves them open, and status is 1",
          "[cli]") {
    const Folder folder;
    const auto in = folder.input("fold.obj", test_support::holed_fold_as_obj());
    const auto refused = folder.run("fill " + in + " -o out.obj");
    CHECK(refused.status == 1);
    CHECK(contains(refused.err, "hole 1 of fold is left open"));
    CHECK(contains(refused.err, "no graph z = f(x, y)"));
    const auto rbf = folder.run("fill " + in + " -o rbf.obj --method rbf");
    INFO(rbf.err);
    CHECK(rbf.status == 0);
    CHECK(folder.run("check rbf.obj").status == 0);
}

TEST_CASE("cli: fill hears a stop request within a second of work, whatever it computes", "[cli]") {
    // So many points round a hole that its filling takes longer than the test waits.
    const Folder folder;
    constexpr int count = 9001, rings = 8;
    std::string text, lying;
    for (int k = 0; k < rings; ++k)
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * 3.14159265358979 * (i + 0.5 * (k % 2)) / count;
            const double radius = 1000 + 2.8 * k;
            const double x = radius * std::cos(angle), y = radius * std::sin(angle);
            const auto u = std::to_string(x), v = std::to_string(y), w = std::to_string(wave(x, y));
            text += "v " + u + " " + w + " " + v + "\n";
            lying += "v " + u + " " + v + " " + w + "\n";
        }
    const auto face = [&](int a, int b, int c) {
        const auto line = "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
                          std::to_string(c + 1) + "\n";
        text += line;
        lying += line;
    };
    for (int k = 0; k + 1 < rings; ++k)
        for (int i = 0; i < count; ++i) {
            const int j = (i + 1) % count, a = k * count + i, b = k * count + j;
            const int c = a + count, d = b + count;
            face(a, k % 2 == 0 ? c : d, k % 2 == 0 ? b : c);
            face(k % 2 == 0 ? b : a, k % 2 == 0 ? c : b, d);
        }
    folder.input("ring.obj", text);
    folder.input("lying.obj", lying);
    using Stop = std::pair<std::string, std::string>;
    for (const auto& [file, moment] :
         {Stop{"lying.obj", "0.3"}, Stop{"ring.obj", "0.7"}, Stop{"ring.obj", "1.4"}}) {
        const auto r = folder.shell("$K TERM " + moment + " $T fill in/" + file +
                                    " -o out.obj --method rbf --threads 1");
        INFO(r.out << r.err);
        CHECK(r.status == 2);
        const std::string said = "terrane: interrupted, nothing written\n";
        REQUIRE(r.err.rfind(said, 0) == 0);
        CHECK(std::stod(r.err.substr(said.size())) < 1.5); // processor seconds that it still took
        CHECK(folder.left().empty());
    }
}
