// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests --seal and --extend from outside.
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// A horizon that ends 0.1 short of a fault at x = 4, in the box from 0 to 8.
const std::string gapped_model = polygon("horizon", "-1 -1 3, 3.9 -1 3, 3.9 9 3, -1 9 3") +
                                 polygon("fault", "4 -1 -1, 4 9 -1, 4 9 9, 4 -1 9");

const std::string around_gap = " --box 0,0,0,8,8,8 ";

} // namespace

TEST_CASE("cli: --seal closes gaps up to its distance and lists what it did", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const auto open = folder.run("volume " + in + " -o open" + around_gap);
    CHECK(contains(open.out, "2 closed blocks, volume 512 in all\n"));
    CHECK_FALSE(contains(open.out, "sealed"));
    CHECK_FALSE(Json::parse(folder.read("open/model.json")).contains("seal"));

    const auto sealed =
        folder.run("volume " + in + " -o sealed --seal 0.11 --stats s.json" + around_gap);
    REQUIRE(sealed.status == 0);
    CHECK(contains(sealed.out, "sealed by at most 0.11: 1 change"));
    CHECK(contains(sealed.out, "horizon extended along"));
    CHECK(contains(sealed.out, "3 closed blocks, volume 512 in all\n"));
    for (const Json& seal : {Json::parse(folder.read("s.json"))["seal"],
                             Json::parse(folder.read("sealed/model.json"))["seal"]}) {
        CHECK(seal["distance"] == 0.11);
        REQUIRE(seal["changes"].size() == 1);
        const Json& change = seal["changes"][0];
        CHECK(change["kind"] == "extended");
        CHECK(change["surface"] == 0);
        CHECK(change["distance"].get<double>() == Approx(0.1));
        CHECK(change["triangles"].get<int>() > 0);
    }
    // The other commands give the same result.
    CHECK(folder.run("arrange " + in + " -o a.obj --seal 0.11" + around_gap).status == 0);
    CHECK(contains(folder.run("volume a.obj -o again").out, "3 closed blocks, volume 512"));
}

TEST_CASE("cli: nothing moves where no gap is small enough: the same bytes", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    REQUIRE(folder.run("arrange " + in + " -o a.vtp -o a.obj").status == 0);
    const auto r = folder.run("arrange " + in + " -o b.vtp -o b.obj --seal 0.0999");
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "sealed by at most 0.0999: no gap is so small"));
    CHECK(folder.shell("cmp a.vtp b.vtp && cmp a.obj b.obj").status == 0);
    REQUIRE(folder.run("arrange " + in + " -o c.vtp --seal 0.11 --threads 1").status == 0);
    REQUIRE(folder.run("arrange " + in + " -o d.vtp --seal 0.11 --threads 2").status == 0);
    CHECK(folder.shell("cmp c.vtp d.vtp").status == 0);
    CHECK(folder.shell("cmp a.vtp c.vtp").status == 1);
}

TEST_CASE("cli: --extend takes horizons to the boundary within its limit", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const std::string roles = " --role fault=fault --role horizon=horizon";
    const auto r =
        folder.run("volume " + in + " -o out --extend 5 --stats s.json" + roles + around_gap);
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "horizon: along 8 at (3.9, 0, 3): extended\n"));
    CHECK(contains(r.out, "4 closed blocks, volume 512 in all\n"));
    const auto extended = Json::parse(folder.read("s.json"))["extended"];
    REQUIRE(extended.size() == 1);
    CHECK(extended[0]["reached"] == true);
    const auto far = folder.run("volume " + in + " -o far --extend 4" + roles + around_gap);
    CHECK(contains(far.out, "horizon: along 8 at (3.9, 0, 3): too far\n"));
    CHECK(contains(far.out, "2 closed blocks, volume 512 in all\n"));
}

TEST_CASE("cli: --seal and --extend refuse what makes no sense", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    for (const std::string options :
         {"--seal -1", "--seal nan", "--seal x", "--extend 1", "--extend -1 --box 0,0,0,8,8,8"}) {
        const auto r = folder.run("arrange " + in + " -o a.obj " + options);
        INFO(options << "\n" << r.err);
        CHECK(r.status == 2);
        CHECK_FALSE(r.err.empty());
    }
    CHECK(folder.left().empty());
}

TEST_CASE("cli: certificates of sealed, extended and cut surfaces that verify takes",
          "[cli][once]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    for (const std::string& options :
         {std::string(" --seal 0.2"), " --seal 0.2" + around_gap, " --extend 5" + around_gap,
          " --seal 0.2 --extend 5" + around_gap, around_gap}) {
        for (const std::string& command :
             {"arrange " + in + " -o out.obj -o out.vtp",
              "improve " + in + " -o out.obj -o out.vtp --edge-length 2 --max-deviation 0.02",
              "volume " + in + " -o out"}) {
            INFO(command << options);
            // Improving takes longest: all options at once, and a box alone, are enough for it.
            const bool has_both = contains(options, "--seal") && contains(options, "--extend");
            if (contains(command, "improve") && !has_both && options != around_gap) continue;
            const auto made = folder.run(command + " --certificate c.json" + options);
            INFO(made.err);
            REQUIRE(made.status == 0);
            const auto valid = folder.run("verify c.json --max-change 5");
            INFO(valid.out << valid.err);
            CHECK(valid.status == 0);
            const bool is_sealed = contains(options, "--seal") || contains(options, "--extend");
            CHECK(contains(valid.out, "sealed or extended: horizon by at most ") == is_sealed);
            CHECK(contains(valid.out, "cut by the polygon") == contains(options, "--box"));
            if (is_sealed) CHECK(folder.run("verify c.json --max-change 0.05").status == 1);
            REQUIRE(folder.shell("rm -r out* c.json").status == 0);
        }
    }
}

TEST_CASE("cli: forged certificates of sealed blocks are refused", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    REQUIRE(folder.run("volume " + in + " -o out --certificate c.json --seal 0.2" + around_gap)
                .status == 0);
    const Json right = Json::parse(folder.read("c.json"));
    struct Forged {
        std::string name;
        std::function<void(Json&)> change;
        std::string rule;
    };
    const std::vector<Forged> all{
        {"a smaller limit", [](Json& c) { c["sealed"][0]["limit"] = "0.05"; }, "R26"},
        {"one surface only", [](Json& c) { c["sealed"].erase(1); }, "R53"},
        {"nothing was added", [](Json& c) { c["sealed"][0]["sealed"] = Json::array(); }, "R1"},
        {"as if nothing was sealed", [](Json& c) { c.erase("sealed"); }, "R1"},
        {"as if nothing was changed",
         [](Json& c) {
             c.erase("sealed");
             c.erase("cut");
         },
         "R1"},
        {"all was kept", [](Json& c) { c["cut"]["dropped"] = Json::array(); }, "R51"},
        {"another box", [](Json& c) { c["cut"]["volume"]["between"][1] = "9"; }, "R50"},
        {"another volume", [](Json& c) { c["blocks"]["volumes"][1] = "1"; }, "R34"},
        {"another number of blocks", [](Json& c) { c["blocks"]["exact"] = 2; }, "R33"},
        {"a file less", [](Json& c) { c["outputs"].erase(2); }, "R21"}};
    for (const Forged& forged : all) {
        INFO(forged.name);
        Json wrong = right;
        forged.change(wrong);
        folder.input("f.json", wrong.dump());
        REQUIRE(folder.shell("mv in/f.json f.json").status == 0);
        const auto refused = folder.run("verify f.json");
        INFO(refused.out);
        CHECK(refused.status == 1);
        CHECK(contains(refused.out, "  " + forged.rule + ": "));
    }
}

TEST_CASE("cli: certificates of tetrahedra in a sealed volume that verify takes", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const auto made = folder.run("tetrahedralize " + in +
                                 " -o m.vtu --certificate c.json --seal 0.2" + around_gap);
    INFO(made.err);
    if (contains(made.err, "terrane-tetgen")) return; // TetGen was not built
    REQUIRE(made.status == 0);
    const auto valid = folder.run("verify c.json");
    INFO(valid.out << valid.err);
    CHECK(valid.status == 0);
    CHECK(contains(valid.out, "m.vtu: holds these tetrahedra: every byte, once decompressed\n"));
}

TEST_CASE("cli: --seal-plot draws what --suggest-seal lists", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const auto r = folder.run("volume " + in + around_gap +
                              " --suggest-seal --seal-plot p.svg --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "wrote p.svg\n"));
    const auto svg = folder.read("p.svg");
    CHECK(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
    CHECK(svg.ends_with("</svg>\n"));
    const auto statistics = Json::parse(folder.read("s.json"));
    // A bar for all blocks and one for small ones of each trial, and the background.
    std::size_t bars = 0;
    for (std::size_t at = 0; (at = svg.find("<rect ", at)) != std::string::npos; ++at) ++bars;
    CHECK(bars == 1 + 2 * statistics["seal_trials"]["trials"].size());
    CHECK(contains(svg, ">2, not sealed<"));
    CHECK(contains(svg, ", chosen<"));
    const auto closed = folder.input("closed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(folder.run("volume " + closed + " --suggest-seal --seal-plot q.svg").status == 0);
    CHECK_FALSE(contains(folder.read("q.svg"), "nan"));
    const auto alone = folder.run("volume " + in + " -o out --seal-plot p.svg");
    CHECK(alone.status == 2);
    CHECK(contains(alone.err, "--seal-plot: draws what --suggest-seal finds"));
}

TEST_CASE("cli: --suggest-seal lists the breaks of gaps and writes nothing", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const auto r = folder.run("volume " + in + around_gap + " --suggest-seal --stats s.json");
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "chosen distance: 0.2\n"));
    const Json stats = Json::parse(folder.read("s.json"));
    CHECK(stats["seal_choice"]["distance"] == 0.2);
    const Json& trials = stats["seal_trials"]["trials"];
    REQUIRE(trials.size() == 2);
    CHECK(trials[0]["blocks"] == 2);
    CHECK(trials[1]["blocks"] == 3);
    CHECK(trials[1]["distance"] == 0.2);
    CHECK(folder.left() == std::set<std::string>{"s.json"});

    for (const std::string option : {"--output model", "--certificate c.json", "--relations r.csv",
                                     "--juxtaposition j.csv", "--gocad m.ml", "--lines l.pl"}) {
        const auto both = folder.run("volume " + in + around_gap + " --suggest-seal " + option);
        CHECK(both.status == 2);
        CHECK(contains(both.err, option.substr(0, option.find(' ')) + ": needs a model"));
        CHECK(folder.left() == std::set<std::string>{"s.json"});
    }
    const auto neither = folder.run("volume " + in + around_gap);
    CHECK(neither.status == 2);
    CHECK(contains(neither.err, "--output"));
}

TEST_CASE("cli: --seal auto takes the last break, says so, and its certificate holds", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const auto r = folder.run("volume " + in + around_gap +
                              " -o model --seal auto --certificate c.json --stats s.json");
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "sealed by at most 0.2: 1 change"));
    CHECK(contains(r.out, "3 closed blocks, volume 512 in all\n"));
    CHECK(folder.run("verify c.json").status == 0);
    REQUIRE(folder.run("volume " + in + around_gap + " -o stated --seal 0.2").status == 0);
    CHECK(folder.shell("cmp model/result.vtp stated/result.vtp").status == 0);
    // Where there is no gap, the certificate is a plain one.
    REQUIRE(
        folder.run("arrange model/result.vtp -o a.obj --seal auto --certificate a.json").status ==
        0);
    CHECK(folder.run("verify a.json").status == 0);
    for (const char* bad : {"''", "0", "-1", "nan", "inf", "1m", "Auto"}) {
        const auto refused = folder.run("volume " + in + " -o bad --seal " + std::string(bad));
        CHECK(refused.status == 2);
        CHECK(contains(refused.err, "--seal"));
    }
}

TEST_CASE("cli: --min-volume merges small blocks and lists them", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", level("top", "4.001") + level("base", "4"));
    const auto r =
        folder.run("volume " + in + around_gap + " -o model --min-volume 1 --stats s.json");
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "blocks below 1: 1 merged with a neighbour\n"));
    CHECK(contains(r.out, "2 closed blocks, volume 512 in all\n"));
    const Json merged = Json::parse(folder.read("s.json"))["small_blocks"];
    CHECK(merged["least_volume"] == 1);
    REQUIRE(merged["merged"].size() == 1);
    CHECK(merged["merged"][0]["volume"].get<double>() == Approx(0.064));
    CHECK(merged["merged"][0]["thickness"].get<double>() == Approx(0.001).epsilon(0.01));
    const auto kept = folder.run("volume " + in + around_gap + " -o kept --min-volume auto");
    REQUIRE(kept.status == 0); // 0.064 is less than a cubic metre, for edges of 10
    CHECK(contains(kept.out, "2 closed blocks"));
    CHECK(contains(folder.run("volume " + in + around_gap + " -o all --min-volume 0.06").out,
                   "3 closed blocks"));
    const auto refused =
        folder.run("volume " + in + around_gap + " -o m --min-volume 1 --certificate c.json");
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "only small blocks were merged"));
    for (const char* bad : {"''", "0", "-1", "nan", "inf"})
        CHECK(folder.run("volume " + in + " -o bad --min-volume " + std::string(bad)).status == 2);
}

TEST_CASE("cli: --seal takes distances by surface and by pair, with a general one or alone",
          "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const auto blocks = [&](const std::string& options) {
        REQUIRE(folder.shell("rm -rf model").status == 0);
        const auto r =
            folder.run("volume " + in + around_gap + " -o model --stats s.json " + options);
        INFO(options << "\n" << r.err);
        REQUIRE(r.status == 0);
        return Json::parse(folder.read("model/model.json"))["blocks"].size() - 1;
    };
    CHECK(blocks("--seal 0.05") == 2);
    CHECK(blocks("--seal 0.05 --seal horizon/fault=0.2") == 3);
    const Json seal = Json::parse(folder.read("s.json"))["seal"];
    CHECK(seal["distance"] == 0.05);
    REQUIRE(seal["rules"].size() == 1);
    CHECK(seal["rules"][0]["surfaces"] == Json({0, 1}));
    CHECK(seal["rules"][0]["names"] == Json({"horizon", "fault"}));
    CHECK(seal["rules"][0]["distance"] == 0.2);
    CHECK(Json::parse(folder.read("model/model.json"))["seal"]["rules"].size() == 1);
    CHECK(blocks("--seal fault=0.2") == 3);
    CHECK(Json::parse(folder.read("model/model.json"))["seal"]["distance"] == 0);
    CHECK(blocks("--seal fault/horizon=0 --seal 0.2") == 2);
    CHECK(blocks("--seal horizon=0 --seal auto") == 2);
    CHECK(blocks("--seal auto --seal horizon=0 --seal fault/horizon=0.2") == 3);
    // The other commands give the same result.
    const auto sealed = folder.run("arrange " + in + " -o a.obj --seal fault=0.2" + around_gap);
    CHECK(contains(sealed.out, "sealed by at most fault 0.2: 1 change"));
    CHECK(contains(folder.run("volume a.obj -o again").out, "3 closed blocks, volume 512"));
}

TEST_CASE("cli: --seal with rules is certified, and refuses what it can't mean", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", gapped_model);
    const auto made =
        folder.run("volume " + in + around_gap + " -o out --certificate c.json --seal fault=0.2");
    REQUIRE(made.status == 0);
    CHECK(folder.run("verify c.json").status == 0);
    const auto refused = [&](const std::string& options, const std::string& message) {
        const auto r = folder.run("volume " + in + around_gap + " -o bad " + options);
        INFO(options << "\n" << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "--seal"));
        CHECK(contains(r.err, message));
    };
    refused("--seal fualt=1", "no surface is called fualt; did you mean fault?");
    refused("--seal horizon/fualt=1", "no surface is called fualt; did you mean fault?");
    refused("--seal x/y=1", "there are horizon, fault");
    CHECK(contains(folder.run("volume " + in + " --suggest-seal --seal x=1").err,
                   "no surface is called x"));
    refused("--seal fault=-1", "at least 0");
    refused("--seal fault=nan", "NAME=D");
    refused("--seal fault=", "NAME=D");
    refused("--seal =1", "NAME=D");
    refused("--seal fault", "NAME=D");
    refused("--seal 1 --seal 2", "second distance");
    refused("--seal 1 --seal auto", "second distance");
}

TEST_CASE("cli: --seal closes a slit, and says what it leaves open and why", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", R"(o horizon
v -1 -1 4
v 5 -1 4
v 9 -1 4
v -1 3.95 4
v 5 3.95 4
v 9 3.95 4
v -1 4.05 4
v 5 4.05 4
v 9 4.05 4
v -1 9 4
v 5 9 4
v 9 9 4
f 1 2 5 4
f 2 3 6 5
f 5 6 9 8
f 7 8 11 10
f 8 9 12 11
o fault
v 4 -1 4.05
v 4 9 4.05
v 4 9 7
v 4 -1 7
f 13 14 15 16
)");
    const auto r = folder.run("volume " + in + around_gap +
                              " -o model --seal 0.2 --seal fault=0 --stats s.json --certificate "
                              "c.json");
    INFO(r.out << r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "2 closed blocks, volume 512 in all\n"));
    CHECK(contains(r.out, "horizon extended along"));
    CHECK(folder.run("verify c.json --max-change 0.2").status == 0);
    CHECK(Json::parse(folder.read("s.json"))["seal"]["open"].empty());
}
