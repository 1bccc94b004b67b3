// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names that are not UTF-8 cannot stand in a certificate: each command that writes one refuses them
// before the work, and writes nothing.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

const std::string two_triangles = "v 0 0 0\nv 7 1 0\nv 1 9 0\nv 2 1 -3\nv 3 7 -1\nv 2.5 3 5\n"
                                  "g plane\nf 1 2 3\n";
const std::string wrong_name = "b\xFF";

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The commands that write certificates: in front of the input file, and behind it.
struct CertifyingCommand {
    std::string before, after;
};

const std::vector<CertifyingCommand> commands{{"arrange", "-o out.obj"},
                                              {"improve", "-o out.obj"},
                                              {"fill", "-o out.obj"},
                                              {"volume", "-o out"},
                                              {"tetrahedralize", "-o out.vtu"}};

} // namespace

TEST_CASE("cli: certificates: a file name that is not UTF-8 is refused before the work", "[cli]") {
    const Folder folder;
    folder.input(wrong_name + ".obj", two_triangles + "g wall\nf 4 5 6\n");
    for (const auto& [before, after] : commands) {
        const std::string line = before + " in/" + wrong_name + ".obj " + after;
        INFO(line);
        const auto refused = folder.run(line + " --certificate c.json");
        CHECK(refused.status == 2);
        CHECK(has(refused.err, "a certificate cannot name this file, as its path is not UTF-8"));
        CHECK(folder.left().empty());
    }
    // Without a certificate the name does not matter.
    CHECK(folder.run("arrange in/" + wrong_name + ".obj -o out.obj").status == 0);
}

TEST_CASE("cli: certificates: an output name that is not UTF-8 is refused before the work",
          "[cli]") {
    const Folder folder;
    folder.input("a.obj", two_triangles + "g wall\nf 4 5 6\n");
    for (const std::string& line :
         {"arrange in/a.obj -o " + wrong_name + ".obj", "volume in/a.obj -o " + wrong_name,
          "tetrahedralize in/a.obj -o " + wrong_name + ".vtu"}) {
        INFO(line);
        const auto refused = folder.run(line + " --certificate c.json");
        CHECK(refused.status == 2);
        CHECK(has(refused.err, "a certificate cannot name this file, as its path is not UTF-8"));
        CHECK(folder.left().empty());
    }
}

TEST_CASE("cli: certificates: a surface's name that is not UTF-8 is refused before the work",
          "[cli]") {
    const Folder folder;
    folder.input("a.obj", two_triangles + "g " + wrong_name + "\nf 4 5 6\n");
    const std::string sentence =
        "in/a.obj: a certificate cannot state the name of surface 2 of 2, as it is not UTF-8";
    for (const auto& [before, after] : commands) {
        INFO(before);
        const auto refused = folder.run(before + " in/a.obj " + after + " --certificate c.json");
        CHECK(refused.status == 2);
        CHECK(has(refused.err, sentence));
        CHECK(folder.left().empty());
    }
    Json project = Json::parse(R"({"format": "terrane-project 1",
                                   "surfaces": [{"file": "a.obj"}],
                                   "outputs": {"surfaces": ["obj"], "certificate": true}})");
    folder.input("p.json", project.dump());
    const auto refused = folder.run("build in/p.json -o out");
    CHECK(refused.status == 2);
    CHECK(has(refused.err, "a certificate cannot state the name of surface 2 of 2"));
    CHECK(folder.left().empty());
    project["outputs"]["certificate"] = false;
    folder.input("p.json", project.dump());
    CHECK(folder.run("build in/p.json -o out").status == 0);
}
