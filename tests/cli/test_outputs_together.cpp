// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests from outside that the outputs of a command appear together or not at all, whatever ends it.
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "holed_fold.hpp"
#include "program.hpp"

using namespace program_test;

namespace {

const std::string model = "model.obj";

} // namespace

TEST_CASE("cli: where one output cannot be written, the others are not", "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input(model, crossing);
    REQUIRE(folder
                .shell("ln -s /dev/full in/full.obj; ln -s /dev/full in/full.json;"
                       "echo old > a.obj")
                .status == 0);
    const std::string box = " --box -1,-2,-2,5,6,4 ";
    for (const std::string& line : std::vector<std::string>{
             "arrange " + in + " -o a.obj -o in/full.obj",
             "arrange " + in + " -o in/full.obj -o a.obj",
             "arrange " + in + " -o a.obj --stats in/full.json",
             "arrange " + in + " -o a.obj --certificate in/full.json",
             "improve " + in + " -o a.obj --histogram in/full.json",
             "volume " + in + " -o b" + box + "--stats in/full.json",
             "volume " + in + " -o b" + box + "--relations r.csv --juxtaposition in/full.json",
             "volume " + in + " -o b" + box + "--relations in/full.json --certificate c.json"}) {
        const auto r = folder.run(line);
        INFO(line << ": " << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "No space left on device"));
        CHECK_FALSE(contains(r.out, "wrote"));
        CHECK(folder.left() == std::set<std::string>{"a.obj"});
        CHECK(folder.read("a.obj") == "old\n");
    }
}

TEST_CASE("cli: a certificate of unpublished files is about what appears", "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input(model, crossing);
    REQUIRE(folder.shell("echo old > a.obj").status == 0);
    REQUIRE(folder.run("arrange " + in + " -o a.obj --certificate c.json").status == 0);
    CHECK(folder.run("verify c.json").status == 0);
    REQUIRE(folder.run("volume " + in + " -o b --box -1,-2,-2,5,6,4 --certificate d.json").status ==
            0);
    CHECK(folder.run("verify d.json").status == 0);
}

TEST_CASE("cli: a limit on the size of files ends with status 2 and no file", "[cli][outputs]") {
    const Folder folder;
    const auto r = folder.shell("ulimit -f 1; $T convert $D/ringmesh/modelA1.ml out.obj");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "out.obj: writing failed: File too large"));
    CHECK(folder.left().empty());
}

TEST_CASE("cli: an interrupt is heard while nobody reads a pipe", "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input(model, crossing);
    const auto r = folder.shell("mkfifo in/p.obj; timeout --preserve-status -k 20 -s INT 1 "
                                "$T arrange " +
                                in + " -o a.vtp -o in/p.obj");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "terrane: interrupted, nothing written"));
    CHECK(folder.left().empty());
}

TEST_CASE("cli: an interrupt ends a command that waits for its input", "[cli][outputs]") {
    const Folder folder;
    REQUIRE(folder.shell("mkfifo in/p").status == 0);
    // The shell opens the pipe for reading and writing, so it never ends.
    const auto r =
        folder.shell("timeout --preserve-status -k 20 -s INT 0.5 $T convert - - --format obj "
                     "--output-format obj <>in/p");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "terrane: interrupted, nothing written"));
}

TEST_CASE("cli: an interrupt ends commands that wait for a project or a certificate",
          "[cli][outputs]") {
    const Folder folder;
    REQUIRE(folder.shell("mkfifo in/p").status == 0);
    for (const std::string command :
         {"build in/p -o out", "verify in/p", "verify -", "ensemble in/p -o out"})
        for (const std::string name : {"INT", "TERM", "HUP"}) {
            INFO(command << ", " << name);
            const auto r = folder.shell("timeout --preserve-status -k 20 -s " + name + " 0.5 $T " +
                                        command + " <>in/p");
            CHECK(r.status == 2);
            CHECK(contains(r.err, "terrane: interrupted"));
            CHECK(folder.left().empty());
        }
}

TEST_CASE("cli: a hangup is an interrupt, but not under nohup", "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input(model, crossing);
    const std::string convert = " convert - - --format obj --output-format obj ";
    const auto plain = folder.shell("(sleep 2; cat " + in +
                                    ") | timeout --preserve-status -s HUP 0.5 $T" + convert);
    CHECK(plain.status == 2);
    CHECK(contains(plain.err, "terrane: interrupted, nothing written"));
    const auto kept = folder.shell("(sleep 2; cat " + in +
                                   ") | timeout --preserve-status -s HUP 0.5 nohup $T" + convert);
    CHECK(kept.status == 0);
    CHECK(contains(kept.out, "f "));
}

TEST_CASE("cli: a file that is given twice is refused before any work", "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input(model, crossing);
    const auto holed = folder.input("fold.obj", test_support::holed_fold_as_obj());
    REQUIRE(folder
                .shell("ln -s model.obj in/link.obj && ln in/model.obj in/hard.obj && mkdir d &&"
                       "ln -s ../new.obj d/link.obj")
                .status == 0);
    struct Twice {
        std::string line, place;
    };
    for (const auto& [line, place] : std::vector<Twice>{
             {"arrange " + in + " -o o.obj --certificate o.obj", "--certificate: names the same"},
             {"arrange " + in + " -o o.obj --certificate d/../o.obj", "--certificate: names the"},
             {"arrange " + in + " -o o.obj -o o.obj", "names the same file as --output: o.obj"},
             {"arrange " + in + " -o new.obj --exact d/link.obj", "--exact: names the same file"},
             {"arrange " + in + " -o o.obj --stats " + in, "--stats: would replace a file that"},
             {"arrange " + in + " -o o.obj --stats in/link.obj", "--stats: would replace a file"},
             {"arrange " + in + " -o o.obj --stats in/hard.obj", "--stats: would replace a file"},
             {"arrange " + in + " -o o.obj --within " + holed + " --stats " + holed,
              "--stats: would"},
             {"fill " + holed + " -o o.obj --points " + holed, "--points: would replace a file"},
             {"fill " + holed + " -o o.obj --points p.csv --map p.csv", " names the same file"},
             {"volume " + in + " -o v --relations v", "--relations: names the same file"}}) {
        const auto r = folder.run(line);
        INFO(line << ": " << r.err);
        CHECK(contains(r.err, place));
        CHECK(r.status == 2);
        CHECK(r.out.empty());
        CHECK(folder.left() == std::set<std::string>{"d"});
        CHECK(folder.read("in/model.obj") == crossing);
    }
    // Surfaces may take the place of those that were read, and devices may be given twice.
    CHECK(folder.run("arrange " + in + " -o " + in).status == 0);
    CHECK(folder.run("arrange " + in + " -o /dev/null --output-format obj --stats /dev/null")
              .status != 2);
}

TEST_CASE("cli: values that are no finite numbers are refused with their option",
          "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input(model, crossing);
    for (const std::string& option : std::vector<std::string>{
             "improve --crease-angle nan", "improve --curve-angle inf", "improve --edge-length NaN",
             "improve --max-volume-change -Infinity", "volume --extend nan", "volume --seal inf",
             "volume --box 0,0,0,1,1,nan", "tetrahedralize --max-volume nan",
             "tetrahedralize --time-limit inf", "volume --seal ''", "improve --edge-length ''",
             "arrange --stats ''"}) {
        const auto space = option.find(' ');
        const auto r = folder.run(option.substr(0, space) + " " + in + " -o out.obj " +
                                  option.substr(space + 1));
        INFO(option << ": " << r.err);
        CHECK(r.status == 2);
        const auto name = option.substr(space + 1, option.rfind(' ') - space - 1);
        CHECK(contains(r.err, name));
        CHECK(folder.left().empty());
    }
}

TEST_CASE("cli: edges of a filling that ask for too many points are refused before work",
          "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input("fold.obj", test_support::holed_fold_as_obj());
    for (const std::string size : {"1e-300", "1e-12", "0.001"})
        for (const std::string method : {"kriging", "rbf"}) {
            const auto r = folder.shell("timeout 20 $T fill " + in + " -o o.obj --mesh-size " +
                                        size + " --method " + method);
            INFO(r.err);
            CHECK(r.status == 2);
            CHECK(contains(r.err, "points in a hole, more than 1e+06"));
            CHECK(folder.left().empty());
        }
}
