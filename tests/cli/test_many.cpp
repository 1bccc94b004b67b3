// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Very many surfaces, and very many blocks: what is written, that it can be read and verified, and that
// each second of a run counts for a stage.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "program.hpp"

using namespace program_test;

namespace {

/// 3 (n + 1) squares that divide a cube of edge n into n^3 blocks.
std::string planes(int n) {
    std::string text;
    int first = 1;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i <= n; ++i) {
            text += fmt::format("o p{}_{}\n", axis, i);
            for (const auto& [a, b] : {std::pair{0, 0}, {n, 0}, {n, n}, {0, n}}) {
                int place[3] = {a, a, a};
                place[axis] = i;
                place[axis == 0 ? 1 : 0] = a;
                place[axis == 2 ? 1 : 2] = b;
                text += fmt::format("v {} {} {}\n", place[0], place[1], place[2]);
            }
            text += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", first, first + 1, first + 2,
                                first + 3);
            first += 4;
        }
    return text;
}

/// n surfaces of one triangle, which do not meet.
std::string triangles(int n, const std::string& name = "s") {
    std::string text;
    for (int i = 0; i < n; ++i)
        text += fmt::format("o {0}{1}\nv {2} 0 0\nv {2} 1 0\nv {3} 0 1\nf {4} {5} {6}\n", name, i,
                            2 * i, 2 * i + 1, 3 * i + 1, 3 * i + 2, 3 * i + 3);
    return text;
}

/// One surface of 2 n^2 triangles.
std::string sheet(int n) {
    std::string text = "o sheet\n";
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) text += fmt::format("v {} {} {}\n", i, j, std::sin(i + j));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = (n + 1) * j + i + 1;
            text += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", a, a + 1, a + n + 2, a + n + 1);
        }
    return text;
}

std::set<std::string> files_in(const Folder& folder, const std::string& name) {
    std::set<std::string> files;
    std::istringstream list(folder.shell("cd " + name + " && find . -type f").out);
    for (std::string line; std::getline(list, line);) files.insert(line.substr(2));
    return files;
}

/// Returns the lines of an OBJ file as triangles, with the coordinates of their corners; each begins at its
/// least corner. Their winding counts.
std::multiset<std::string> triangles_of(const std::string& obj) {
    std::vector<std::string> vertices;
    std::multiset<std::string> all;
    std::istringstream lines(obj);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("v ")) vertices.push_back(line);
        if (!line.starts_with("f ")) continue;
        std::istringstream corners(line.substr(2));
        std::vector<std::string> found;
        for (std::size_t v = 0; corners >> v;) found.push_back(vertices.at(v - 1));
        std::rotate(found.begin(), std::min_element(found.begin(), found.end()), found.end());
        all.insert(found.at(0) + found.at(1) + found.at(2));
    }
    return all;
}

/// Tells whether the stages of a run took what it took, within 5 %. What the machine does in between
/// counts as well, so the best of three runs does.
void expect_sum(const Folder& folder, const std::string& command) {
    INFO(command);
    double best = HUGE_VAL;
    std::string stages;
    for (int k = 0; k < 3 && best > 0.05; ++k) {
        REQUIRE(folder.shell("rm -rf out*").status == 0);
        const auto done = folder.run(command + " --stats s.json");
        INFO(done.err);
        REQUIRE(done.status <= 1);
        const auto json = Json::parse(folder.read("s.json"))["seconds"];
        double sum = 0;
        for (const auto& [stage, seconds] : json.items())
            if (stage != "total") sum += seconds.get<double>();
        const double total = json["total"];
        best = std::min(best, std::abs(sum - total) / total);
        stages = json.dump();
    }
    INFO(stages);
    CHECK(best <= 0.05);
}

} // namespace

TEST_CASE("cli: volume: more than 1000 parts are two files", "[cli][once]") {
    constexpr int n = 7; // 343 blocks, 1176 interfaces
    const Folder folder;
    const auto in = folder.input("planes.obj", planes(n));
    const auto made = folder.run("volume " + in + " -o out --certificate c.json");
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "343 closed blocks, volume 343 in all\n"));
    CHECK(files_in(folder, "out") == std::set<std::string>{"blocks.vtp", "interfaces.vtp",
                                                           "model.json", "model.vtm",
                                                           "result.vtp"});
    const auto json = Json::parse(folder.read("out/model.json"));
    CHECK(json["blocks"].size() == n * n * n + 1);
    CHECK_FALSE(json["blocks"][0].contains("file"));
    CHECK(json["blocks"][1]["file"] == "blocks.vtp");
    CHECK(json["interfaces"].size() == 3 * n * n * (n + 1));
    CHECK(json["interfaces"][0]["file"] == "interfaces.vtp");
    CHECK(contains(folder.read("out/blocks.vtp"), "Name=\"block\""));
    const auto verified = folder.run("verify c.json");
    INFO(verified.out);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out,
                   "out/blocks.vtp: holds these triangles: every byte, once decompressed\n"));

    // The two files hold all that the single ones hold together, with its winding.
    REQUIRE(folder.run("volume " + in + " -o single --parts vtp").status == 0);
    CHECK(files_in(folder, "single").size() == 3 + 343 + 1176);
    for (const std::string kind : {"block", "interface"}) {
        REQUIRE(folder.run("convert out/" + kind + "s.vtp together.obj").status == 0);
        std::multiset<std::string> single;
        const std::size_t count = json[kind + "s"].size();
        for (std::size_t i = kind == "block" ? 1 : 0; i < count; i += 13) {
            const auto file = fmt::format("single/{0}s/{0}_{1}.vtp", kind, i);
            REQUIRE(folder.run("convert " + file + " one.obj").status == 0);
            single.merge(triangles_of(folder.read("one.obj")));
        }
        const auto together = triangles_of(folder.read("together.obj"));
        CHECK(together.size() == (kind == "block" ? 12U * n * n * n : 2U * count));
        CHECK(std::includes(together.begin(), together.end(), single.begin(), single.end()));
    }
    REQUIRE(folder.run("volume single/blocks/block_5.vtp -o five").status == 0);
    CHECK(Json::parse(folder.read("five/model.json"))["blocks"][1]["volume"] == 1);
    // Blocks are read as surfaces like any others; a triangle between two is there twice.
    REQUIRE(folder.run("volume out/blocks.vtp -o again").status == 0);
    CHECK(Json::parse(folder.read("again/model.json"))["blocks"].size() == n * n * n + 1);
}

TEST_CASE("cli: volume: a part names its own surfaces alone", "[cli]") {
    const Folder folder;
    const auto in = folder.input("planes.obj", planes(2));
    REQUIRE(folder.run("volume " + in + " -o out").status == 0);
    const auto json = Json::parse(folder.read("out/model.json"));
    for (std::size_t i = 0; i < json["interfaces"].size(); ++i) {
        const auto file = json["interfaces"][i]["file"].get<std::string>();
        const auto text = folder.read("out/" + file);
        CHECK(contains(text, "Name=\"surface_name\" NumberOfTuples=\"1\""));
        REQUIRE(folder.run("convert out/" + file + " one.obj").status == 0);
        const auto name = json["surfaces"][json["interfaces"][i]["surfaces"][0].get<std::size_t>()];
        CHECK(contains(folder.read("one.obj"), name["name"].get<std::string>() + "\n"));
    }
}

TEST_CASE("cli: volume: the files do not grow with the number of surfaces", "[cli][once]") {
    const Folder folder;
    for (const std::string options : {"", " --parts vtp", " --parts obj"}) {
        std::map<int, std::size_t> bytes;
        for (const int n : {400, 1600}) { // below and above 1000 parts
            const auto in = folder.input("many.obj", triangles(n));
            REQUIRE(folder.run("volume " + in + " -o out" + options).status == 0);
            bytes[n] = std::stoul(folder.shell("find out -type f -exec cat {} + | wc -c").out);
            REQUIRE(folder.shell("rm -r out").status == 0);
        }
        INFO(options << " " << bytes[400] << " " << bytes[1600]);
        CHECK(bytes[1600] < 5 * bytes[400]);
    }
}

TEST_CASE("cli: each second of a run counts for a stage", "[cli][once]") {
    const Folder folder;
    const auto surfaces = folder.input("surfaces.obj", triangles(20000));
    const auto vertices = folder.input("vertices.obj", sheet(150));
    const auto parts = folder.input("parts.obj", planes(9));
    const auto names = folder.input("names.obj", triangles(2000, std::string(5000, 'n')));
    for (const auto& in : {surfaces, vertices, parts, names}) {
        expect_sum(folder, "arrange " + in + " -o out.vtp --certificate out.json");
        expect_sum(folder, "volume " + in + " -o out --report out.html");
        expect_sum(folder, "report " + in + " -o out.html");
    }
    expect_sum(folder, "volume " + parts + " -o out --parts obj --certificate out.json");
    expect_sum(folder, "improve " + vertices + " -o out.vtp");
    expect_sum(folder, "fill " + vertices + " -o out.vtp");
    expect_sum(folder, "layer " + vertices + " --layer sheet=1 -o out.vtp");
    expect_sum(folder, "tetrahedralize " + parts + " -o out.vtu --blocks-only");
}
