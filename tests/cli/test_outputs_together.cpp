// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests from outside that the outputs of a command appear together or not at all, whatever ends it.
#include <csignal>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

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
    const auto r =
        folder.shell("mkfifo in/p.obj; $K INT waits $T arrange " + in + " -o a.vtp -o in/p.obj");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "terrane: interrupted, nothing written"));
    CHECK(folder.left().empty());
}

TEST_CASE("cli: an interrupt ends a command that waits for its input", "[cli][outputs]") {
    const Folder folder;
    REQUIRE(folder.shell("mkfifo in/p").status == 0);
    // The shell opens the pipe for reading and writing, so it never ends.
    const auto r =
        folder.shell("$K INT waits $T convert - - --format obj --output-format obj <>in/p");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "terrane: interrupted, nothing written"));
}

TEST_CASE("cli: an interrupt ends commands that wait for a project or a certificate",
          "[cli][outputs]") {
    const Folder folder;
    REQUIRE(folder.shell("mkfifo in/p").status == 0);
    for (const std::string command : {"build in/p -o out", "verify -", "ensemble in/p -o out"})
        for (const std::string name : {"INT", "TERM", "HUP"}) {
            INFO(command << ", " << name);
            const auto r = folder.shell("$K " + name + " waits $T " + command + " <>in/p");
            CHECK(r.status == 2);
            CHECK(contains(r.err, "terrane: interrupted"));
            CHECK(folder.left().empty());
        }
}

TEST_CASE("cli: a hangup is an interrupt, but not under nohup", "[cli][outputs]") {
    const Folder folder;
    const auto in = folder.input(model, crossing);
    const std::string then = "$K HUP waits --then " + in;
    const std::string convert = " $T convert - - --format obj --output-format obj";
    const auto plain = folder.shell(then + convert);
    CHECK(plain.status == 2);
    CHECK(contains(plain.err, "terrane: interrupted, nothing written"));
    const auto kept = folder.shell(then + " nohup" + convert);
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
            const auto r =
                folder.run("fill " + in + " -o o.obj --mesh-size " + size + " --method " + method);
            INFO(r.err);
            CHECK(r.status == 2);
            CHECK(contains(r.err, "points in a hole, more than 1,000,000"));
            CHECK(folder.left().empty());
        }
}

namespace {

const auto horizons = level("base", "3") + level("top", "5");
const auto fault = "o F\nv 4 -1 -1\nv 4 4 -1\nv 4 4 9\nv 4 -1 9\nf 1 2 3 4\n";
const auto outline_text = "0 0\n8 0\n8 8\n0 8\n";

/// A folder with horizons, a fault, files of a volume of interest and projects, all of which must
/// stay as they are.
class Inputs {
public:
    Inputs() {
        for (const auto& [name, text] : files) folder.input(name, text);
    }
    void check_unchanged() const {
        for (const auto& [name, text] : files) CHECK(folder.read("in/" + name) == text);
    }
    /// Checks that a command is refused with a sentence, before any work.
    void check_refused(const std::string& line, const std::string& sentence) const {
        const auto before = folder.left();
        const auto r = folder.run(line);
        INFO(line << ": " << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, sentence));
        CHECK(r.out.empty());
        CHECK(folder.left() == before);
        check_unchanged();
    }

    const Folder folder;
    const std::vector<std::pair<std::string, std::string>> files{
        {"in.obj", horizons},
        {"fault.obj", fault},
        {"poly.txt", outline_text},
        {"box.obj", "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 0 0 8\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"},
        {"map.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 9\n1 1\n1 1\n"},
        {"column.json", R"({"column": [{"unit": "a", "surface": "top"}, {"unit": "b"}]})"},
        {"p.json",
         R"({"format": "terrane-project 1", "folder": "../out",
 "surfaces": [{"file": "in.obj", "role": "horizon"}, {"file": "fault.obj", "role": "fault"}],
 "uncertainty": [{"surface": "top", "field": {"range": 5, "map": "map.asc"}}],
 "volume_of_interest": {"within": ["box.obj"]}, "outputs": {"surfaces": ["obj"]}})"},
        {"stages.json", R"({"format": "terrane-project 1", "folder": "../in/made",
 "surfaces": [{"file": "made.stages/improve"}], "outputs": {"surfaces": ["obj"]}})"}};
};

const std::string surfaces = " in/in.obj in/fault.obj ";
const std::string bounded = surfaces + "--box 0,0,0,8,8,8 ";

} // namespace

TEST_CASE("cli: a file that is read is replaced only by surfaces made of it", "[cli][outputs]") {
    const Inputs in;
    const std::string replaced = "would replace a file that is read: in/";
    const std::string by_polygon = "arrange" + surfaces + "--polygon in/poly.txt --between 0,8 ";
    in.check_refused(by_polygon + "-o a.obj --stats in/poly.txt", "--stats: " + replaced);
    in.check_refused(by_polygon + "-o in/poly.txt --output-format obj", "--output: " + replaced);
    in.check_refused("arrange" + surfaces + "--within in/box.obj -o in/box.obj",
                     "--output: " + replaced);
    in.check_refused("volume" + bounded + "-o v --column in/column.json --relations in/column.json",
                     "--relations: " + replaced);
    in.check_refused("tetrahedralize" + bounded +
                         "-o in/column.json --output-format obj "
                         "--column in/column.json",
                     "--output: " + replaced);
    in.check_refused("report" + surfaces + "-o in/in.obj", "--output: " + replaced);
    in.check_refused("arrange - --format obj -o a.obj --stats in/in.obj <in/in.obj",
                     "--stats: " + replaced);
    // Numbers name no file, even one that there is.
    REQUIRE(in.folder.shell("echo x > 0,0,8,0,8,8").status == 0);
    const auto numbers = in.folder.run(
        "arrange" + surfaces + "--polygon 0,0,8,0,8,8 --between 0,8 -o a.obj --stats 0,0,8,0,8,8");
    INFO(numbers.err);
    CHECK(numbers.status == 0);
    CHECK(in.folder.run("layer --hard in/in.obj --soft in/fault.obj --help").status == 0);
}

TEST_CASE("cli: build replaces no file that the project names", "[cli][outputs]") {
    const Inputs in;
    for (const char* const file : {"in.obj", "fault.obj", "box.obj", "map.asc", "p.json"})
        in.check_refused("build in/p.json --report in/" + std::string(file),
                         "--report: would replace a file that is read: in/" + std::string(file));
    in.check_refused("build in/p.json --report out", "names the same file as --report");
    in.check_refused("build in/p.json -o r.html --report r.html", "--report: names the same file");
    in.check_refused("build in/p.json -o in", "the folder is there already and not empty");
    in.check_refused("build in/stages.json --resume", "--resume: would replace a file");
}

TEST_CASE("cli: files next to an output are not replaced by another one", "[cli][outputs]") {
    const Inputs in;
    const std::string mesh = "tetrahedralize" + bounded + "--quiet ";
    const std::string begins = ", whose names begin with t_";
    in.check_refused(mesh + "-o t.vtm --output-format geos --stats t_main.vtu",
                     "--stats: t_main.vtu may be one of the files next to t.vtm" + begins);
    in.check_refused(mesh + "-o ./t.ugi --stats $PWD/t_below_base.txt",
                     "may be one of the files next to ./t.ugi" + begins);
    in.check_refused(mesh + "-o t.ugi --report t_below_base.ss", "next to t.ugi" + begins);
    in.check_refused(mesh + "-o t.vtu --output-format ogs -o t_F_front.vtu", "t.vtu" + begins);
    for (const char* const other : {"t_a.vtm", "./t.vtu", "$PWD/t_.vtm"})
        in.check_refused(mesh + "-o t.vtm --output-format geos -o " + other, begins);
    in.check_refused("tetrahedralize in/in.obj t_below_base.txt --input-format obj --box "
                     "0,0,0,8,8,8 --quiet -o t.ugi",
                     "IN: t_below_base.txt may be one of the files next to t.ugi" + begins);
    // A link to a name that may be taken is that name.
    REQUIRE(in.folder.shell("ln -s t_main.vtu other.json; mkdir t_more").status == 0);
    in.check_refused(mesh + "-o t.vtm --output-format geos --stats other.json", "next to t.vtm");
    const auto apart = in.folder.run(mesh + "-o t.vtm --output-format geos -o t_more/t.vtm "
                                            "--stats t_main.json --report t.html");
    INFO(apart.err);
    CHECK(apart.status == 0);
}

TEST_CASE("cli: a file next to an output takes the place of no other, whatever names are",
          "[cli][outputs]") {
    // The program writes t_main.vtu next to t.vtm, and the link leads it to the statistics.
    const Inputs in;
    REQUIRE(in.folder.shell("ln -s s.json t_main.vtu").status == 0);
    in.check_refused("tetrahedralize" + bounded +
                         "--quiet -o t.vtm --output-format geos --stats s.json",
                     "two results of this run would be in the same place");
}

TEST_CASE("cli: pieces of a mesh are not replaced by another output", "[cli][outputs]") {
    const Inputs in;
    const std::string mesh = "arrange" + surfaces + "-o a.pvtp --memory 1GiB ";
    in.check_refused(mesh + "--stats a_pieces", "--stats: names the same file as --output");
    REQUIRE(in.folder.shell("mkdir a_pieces").status == 0);
    in.check_refused(mesh + "--stats a_pieces/s.json", "--stats: names a file in another one");
    in.check_refused("volume" + bounded + "-o a_pieces --relations a_pieces/r.csv",
                     "--relations: names a file in another one");
}

TEST_CASE("cli: standard output takes one file, by any of its names", "[cli][outputs]") {
    const Inputs in;
    const std::string only = "standard output can take only one file";
    for (const char* const name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "-"}) {
        const std::string to = name;
        in.check_refused("arrange" + surfaces + "-o - --output-format obj --stats " + to, only);
        in.check_refused("arrange" + surfaces + "-o " + to + " --output-format obj --stats -",
                         only);
        in.check_refused("volume" + bounded + "-o v --relations - --juxtaposition " + to, only);
        if (to != "-")
            in.check_refused("arrange" + surfaces + "-o - --output-format obj --certificate " + to,
                             only);
        const auto piped =
            in.folder.shell("{ $T arrange" + surfaces + "-o - --output-format obj --stats " + to +
                            "; echo $? >&2; } | cat");
        CHECK(contains(piped.err, only));
        CHECK(contains(piped.err, "\n2\n"));
    }
    const auto other = in.folder.run("arrange" + surfaces +
                                     "-o - --output-format obj --stats /dev/stderr 2>/dev/null");
    CHECK(other.status == 0);
    CHECK(contains(other.out, "\nf "));
}

TEST_CASE("cli: every output is checked before any work", "[cli][outputs]") {
    const Inputs in;
    REQUIRE(in.folder.shell("mkdir d").status == 0);
    for (const std::string& line : std::vector<std::string>{
             "volume" + bounded + "-o v --relations ", "volume" + bounded + "-o v --juxtaposition ",
             "volume" + bounded + "-o v --gocad ", "volume" + bounded + "-o v --lines ",
             "volume" + bounded + "-o v --certificate ", "volume" + bounded + "-o v --report ",
             "volume" + bounded + "--suggest-seal --seal-plot ",
             "arrange" + surfaces + "-o a.obj --exact ",
             "improve" + surfaces + "-o a.obj --histogram ", "fill" + surfaces + "-o a.obj --map ",
             "fill" + surfaces + "-o a.obj --points ", "check" + surfaces + "--report ",
             "tetrahedralize" + bounded + "-o a.vtu --stats ", "convert in/in.obj "}) {
        in.check_refused(line + "none/x.csv", "none/x.csv: there is no folder none");
        in.check_refused(line + "d", "d: this is a folder");
    }
}

TEST_CASE("cli: numbers that an option cannot have are refused with its name", "[cli][outputs]") {
    const Inputs in;
    struct Wrong {
        std::string line, sentence;
    };
    const std::string fill_all = "tetrahedralize" + surfaces + "-o a.vtu ";
    const std::string improve = "improve" + surfaces + "-o a.obj ";
    for (const auto& [line, sentence] : std::vector<Wrong>{
             {fill_all + "--time-limit 1e999", "--time-limit: needs a finite number, not 1e999"},
             {fill_all + "--size-of base=nan", "--size-of: needs a finite number, not base=nan"},
             {fill_all + "--size-of base=1e999", "--size-of: needs"},
             {fill_all + "--size-of base=-1", "--size-of: needs NAME=L, with a positive length"},
             {fill_all + "--size-in 3=inf", "--size-in: needs a finite number"},
             {fill_all + "--time-limit 0x10", "--time-limit: needs a decimal number, not 0x10"},
             {fill_all + "--threads 0x1", "--threads: needs a decimal number, not 0x1"},
             {fill_all + "--threads 010", "--threads: needs a number without a zero before it"},
             {fill_all + "--margin 1e10", "--margin: margin must be at most 1000000000"},
             {fill_all + "--around -2,-2,-2,10,10,1e20", "--around: box is"},
             {improve + "--max-volume-change 1e999", "--max-volume-change: needs a finite number"},
             {improve + "--edge-length 0x10", "--edge-length: needs a decimal number"},
             {improve + "--edge-length-of base=0x10", "--edge-length-of: needs a decimal number"},
             {improve + "--passes 1e999", "--passes"},
             {improve + "--layers-in-gaps 1e20", "--layers-in-gaps: must be at most 1000"},
             {"volume" + surfaces + "-o v --box 0,0,0,8,8,1e999", "--box: needs a finite number"},
             {"volume" + surfaces + "-o v --seal base=0x1", "--seal"}}) {
        const auto r = in.folder.run(line + " --quiet");
        INFO(line << ": " << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, sentence));
        CHECK(in.folder.left().empty());
    }
    // Names and files may look like such numbers.
    REQUIRE(in.folder.shell("cp in/in.obj inf; cp in/in.obj 0x10").status == 0);
    CHECK(in.folder.run("arrange inf 0x10 --input-format obj -o a.obj").status == 0);
}

TEST_CASE("cli: an error names a file by its final name", "[cli][outputs]") {
    const Inputs in;
    for (const std::string& line :
         std::vector<std::string>{"volume" + bounded + "-o v", "build in/p.json -o v"}) {
        const auto r = in.folder.shell("ulimit -f 1; $T " + line);
        INFO(r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "terrane: v/"));
        CHECK(contains(r.err, ": writing failed: File too large"));
        CHECK_FALSE(contains(r.err, ".part"));
        CHECK(in.folder.left().empty());
    }
}

TEST_CASE("cli: a signal that ends the program leaves no temporary file", "[cli][outputs]") {
    const Inputs in;
    // The second output is a pipe that nobody reads, so that the first one waits for its name.
    REQUIRE(in.folder.shell("mkfifo in/p.obj").status == 0);
    const std::string waits = " arrange in/in.obj -o a.vtp -o in/p.obj";
    for (const int signal : {SIGQUIT, SIGALRM, SIGVTALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGPROF}) {
        const auto r = in.folder.shell(fmt::format("ulimit -c 0; $K {} waits $T {}; test $? -eq {}",
                                                   signal, waits, 128 + signal));
        INFO(signal << ": " << r.err);
        CHECK(r.status == 0);
        CHECK(in.folder.left().empty());
    }
}

TEST_CASE("cli: a limit on processor time leaves no temporary file", "[cli][outputs]") {
    const Inputs in;
    const auto r = in.folder.shell("ulimit -c 0; ulimit -t 1; $T improve" + surfaces +
                                   "-o a.obj --edge-length 0.02 --quiet; test $? -ge 128");
    INFO(r.err);
    CHECK(r.status == 0);
    CHECK(in.folder.left().empty());
}

TEST_CASE("cli: a signal that the caller ignores stays ignored", "[cli][outputs]") {
    const Inputs in;
    for (const std::string signal : {"INT", "TERM", "HUP", "QUIT", "USR1"}) {
        const auto r =
            in.folder.shell("$K " + signal + " waits --then in/in.obj sh -c \"trap '' " + signal +
                            "; exec '$T' convert - - --format obj --output-format obj\"");
        INFO(signal << ": " << r.err);
        CHECK(r.status == 0);
        CHECK(contains(r.out, "\nf "));
    }
}

TEST_CASE("cli: a result that a closed standard output loses is status 2", "[cli][outputs]") {
    const Inputs in;
    for (const std::string line :
         {"check in/in.obj --json", "completion bash", "--version", "arrange --help"}) {
        const auto r = in.folder.shell("$T " + line + " >&-");
        INFO(line << ": " << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "standard output: "));
    }
    CHECK(in.folder.shell("$T check in/in.obj >&-").status == 0); // a summary may get lost
}
