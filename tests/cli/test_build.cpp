// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane build` from outside.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "boxed_project.hpp"
#include "program.hpp"

using namespace program_test;

TEST_CASE("cli: build writes the model with its regions for GOCAD", "[cli][gocad]") {
    const Case c;
    auto project = boxed_project();
    project["outputs"] = {{"gocad", true}};
    const auto r = c.build(project);
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(c.files("out") == "log.txt\nmodel.ml\nstatistics.json\n");
    REQUIRE(c.folder.run("volume out/model.ml -o again --gocad again.ml").status == 0);
    const auto model = Json::parse(c.folder.read("again/model.json"));
    REQUIRE(model["blocks"].size() == 4);
    CHECK(model["blocks"][2]["name"] == "below top, above base");
    CHECK(model["blocks"][2]["volume"] == 128);
    CHECK(model["surfaces"][2]["role"] == "fault");
}

TEST_CASE("cli: build makes blocks in a box, in one folder", "[cli]") {
    const Case c;
    const auto r = c.build(boxed_project());
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(r.err.empty());
    CHECK(contains(r.out, "3 closed blocks, volume 512 in all"));
    CHECK(contains(r.out, "wrote out:\n  surfaces.vtp\n  surfaces_22.msh\n  model/\n"));
    CHECK(c.files("out") == "log.txt\nmodel\nstatistics.json\nsurfaces.vtp\nsurfaces_22.msh\n");
    const auto model = Json::parse(c.folder.read("out/model/model.json"));
    REQUIRE(model["blocks"].size() == 4);
    CHECK(model["blocks"][2]["volume"] == 128);
    CHECK(model["surfaces"][0]["name"] == "base");
    CHECK(model["surfaces"][0]["role"] == "horizon");
    CHECK(model["surfaces"][2]["name"] == "F1");
    CHECK(model["surfaces"][2]["role"] == "fault");
    CHECK(model["surfaces"][3]["role"] == "boundary");
    const auto statistics = Json::parse(c.folder.read("out/statistics.json"));
    CHECK(statistics["input"]["surfaces"] == 3);
    CHECK(statistics["volumes"]["blocks"] == Json({192, 128, 192}));
    CHECK(statistics["seconds"].contains("total"));
    // The log has the output, in order.
    const auto log = c.folder.read("out/log.txt");
    std::size_t at = 0;
    for (std::size_t line = 0, end = 0; line < r.out.size(); line = end + 1) {
        end = r.out.find('\n', line);
        at = log.find(r.out.substr(line, end - line), at);
        CHECK(at != std::string::npos);
    }
    CHECK(contains(log, "s] stage 2 of 4: arrange\n"));
    CHECK(r.out.starts_with("stage 1 of 4: read\nstage 2 of 4: arrange\n"));
    CHECK(contains(r.out, "\nstage 4 of 4: write\nwrote out:\n"));
}

TEST_CASE("cli: build takes paths from the folder of the project", "[cli]") {
    const Case c;
    auto json = boxed_project();
    json["folder"] = "run";
    REQUIRE(c.build(json, "").status == 0);
    CHECK(c.files("in/run").starts_with("log.txt\nmodel\n"));
    REQUIRE(c.folder.shell("cd / && $T build $OLDPWD/in/p.json -o $OLDPWD/out").status == 0);
    CHECK(c.folder.shell("diff -r -x log.txt -x statistics.json in/run out").status == 0);
}

TEST_CASE("cli: build: each kind of volume of interest", "[cli]") {
    const Case c;
    const auto volume_of = [&](const std::string& volume, const std::string& to) {
        auto json = boxed_project();
        json["volume_of_interest"] = Json::parse(volume);
        const auto r = c.build(json, "-o " + to);
        INFO(r.err);
        REQUIRE(r.status == 0);
        return double(Json::parse(c.folder.read(to + "/statistics.json"))["volumes"]["all"]);
    };
    CHECK(volume_of(R"({"polygon": {"corners": [[0, 0], [8, 0], [0, 8]], "between": [4, 0]}})",
                    "polygon") == 128);
    CHECK(std::fabs(volume_of(R"({"rotated_box": {"centre": [4, 4, 4], "lengths": [2, 3, 4],
                                                  "azimuth": 30}})",
                              "turned") -
                    24) < 1e-9);
    CHECK(volume_of(R"({"rotated_box": {"corner": [1, 1, 1], "lengths": [2, 3, 4]}})", "corner") ==
          Approx(24));
    c.folder.input("tetrahedron.obj", "v 0 0 0\nv 6 0 0\nv 0 6 0\nv 0 0 6\nf 1 3 2\nf 1 2 4\n"
                                      "f 2 3 4\nf 1 4 3\n");
    CHECK(volume_of(R"({"within": ["tetrahedron.obj"]})", "within") == 36);
    auto json = boxed_project();
    json["volume_of_interest"] = Json::parse(R"({"within": ["fault.obj"]})");
    const auto open = c.build(json, "-o open");
    CHECK(open.status == 1);
    CHECK(contains(open.err, "terrane: "));
    json["volume_of_interest"] = Json::parse(R"({"box": {"low": [0, 0, 0], "high": [8, 0, 8]}})");
    const auto flat = c.build(json, "-o flat");
    CHECK(flat.status == 2);
    CHECK(contains(flat.err, "p.json: volume_of_interest: "));
}

TEST_CASE("cli: build: gaps are closed, horizons extended, triangles made better", "[cli]") {
    const Case c;
    // The fault ends 0.25 below the top and above the base; the horizons end inside the box.
    c.folder.input("fault.obj", "v 4 -1 3.25\nv 4 9 3.25\nv 4 9 4.75\nv 4 -1 4.75\nf 1 2 3 4\n");
    c.folder.input("layers.obj", "o base\nv 1 1 3\nv 7 1 3\nv 7 7 3\nv 1 7 3\nf 1 2 3 4\n"
                                 "o top\nv 1 1 5\nv 7 1 5\nv 7 7 5\nv 1 7 5\nf 5 6 7 8\n");
    auto json = boxed_project();
    const auto blocks = [&](const std::string& to) {
        const auto r = c.build(json, "-o " + to);
        INFO(r.err);
        REQUIRE(r.status == 0);
        const auto statistics = Json::parse(c.folder.read(to + "/statistics.json"));
        CHECK(double(statistics["volumes"]["all"]) == Approx(512));
        return int(statistics["volumes"]["blocks"].size());
    };
    CHECK(blocks("open") == 1);
    json["extend"] = 1.5;
    CHECK(blocks("extended") == 3);
    json["seal"] = 0.5;
    CHECK(blocks("sealed") == 4);
    const auto model = Json::parse(c.folder.read("sealed/model/model.json"));
    CHECK_FALSE(model["seal"].empty());
    json["seal"] = "auto"; // the gaps are a quarter, the triangles' edges six wide
    CHECK(blocks("automatic") == 4);
    CHECK(Json::parse(c.folder.read("automatic/statistics.json"))["seal_choice"]["distance"] ==
          0.5);
    json["seal_of"] = {{"F1", 0}};
    CHECK(blocks("excepted") == 3);
    json["seal_of"] = {{"F1/top", 0.5}, {"F1/base", 0.5}};
    json.erase("seal");
    CHECK(blocks("by_pairs") == 4);
    json["seal_of"] = {{"F1/tpo", 1}};
    const auto unknown = c.build(json, "-o unknown");
    CHECK(unknown.status == 2);
    CHECK(contains(unknown.err, "seal_of.F1/tpo: no surface is called tpo; did you mean top?"));
    json.erase("seal_of");
    json["seal"] = "auto";
    json["min_volume"] = 100;
    CHECK(blocks("merged") < 4);
    json.erase("min_volume");
    json["improve"] = {{"edge_length", 1}, {"edge_length_of", {{"F1", 0.5}}}};
    CHECK(blocks("better") == 4);
    CHECK(contains(c.folder.read("better/log.txt"), ": improve\n"));
    const auto before = Json::parse(c.folder.read("sealed/statistics.json"));
    const auto after = Json::parse(c.folder.read("better/statistics.json"));
    CHECK(int(after["output"]["triangles"]) > int(before["output"]["triangles"]));
    CHECK(double(after["quality"]["after"]["q"]["mean"]) >
          double(after["quality"]["before"]["q"]["mean"]));
    json["improve"] = {{"edge_length_of", {{"F2", 0.5}}}};
    const auto r = c.build(json, "-o refused");
    CHECK(r.status == 2);
    CHECK(contains(r.err, "in/p.json: improve.edge_length_of.F2: no surface is called F2"));
}

TEST_CASE("cli: build: a certificate that verify takes", "[cli]") {
    const Case c;
    auto json = boxed_project();
    json.erase("volume_of_interest");
    json["surfaces"][0].erase("objects");
    json["outputs"]["certificate"] = true;
    const auto r = c.build(json);
    INFO(r.err);
    REQUIRE(r.status == 0);
    const auto verified = c.folder.run("verify --folder . out/certificate.json");
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "surfaces.vtp: holds these triangles: every byte"));
    CHECK(contains(verified.out, "surfaces_22.msh: holds these triangles: every byte"));
    const auto blocks = c.folder.run("verify --folder . out/certificate_blocks.json");
    INFO(blocks.out);
    CHECK(blocks.status == 0);
    CHECK(contains(blocks.out, "model/result.vtp: holds these triangles: every byte"));
    c.folder.input("fault.obj", std::string(fault) + "v 0 0 0\n"); // differs from what was read
    CHECK(c.folder.run("verify --folder . out/certificate.json").status == 1);
    CHECK(c.folder.run("verify --folder . out/certificate_blocks.json").status == 1);
}

TEST_CASE("cli: build: with --check full all pairs of boxes are tested, with the same result",
          "[cli]") {
    const Case c;
    REQUIRE(c.build(boxed_project(), "-o bounds").status == 0);
    const auto full = c.build(boxed_project(), "-o full --check full");
    INFO(full.err);
    REQUIRE(full.status == 0);
    CHECK(contains(
        full.out,
        "; 0 cleared by proven bounds (0 in injective patches, 0 by separation); 0 not moved"));
    CHECK(c.folder.read("full/surfaces.vtp") == c.folder.read("bounds/surfaces.vtp"));
    CHECK(c.build(boxed_project(), "-o other --check some").status == 2);
}

TEST_CASE("cli: build: what is wrong is named by its key, and nothing is written", "[cli]") {
    const Case c;
    const auto refused = [&](const Json& json, const std::string& reason, int status = 2,
                             const std::string& arguments = "-o out") {
        const auto r = c.build(json, arguments);
        INFO(r.err);
        CHECK(r.status == status);
        CHECK(contains(r.err, reason));
        CHECK(c.folder.left().empty());
    };
    auto json = boxed_project();
    refused(json, "in/p.json: the key folder is missing, and there is no -o", 2, "");
    json["surfaces"][1]["rolle"] = "fault";
    refused(json, "in/p.json: surfaces[1].rolle: unknown key; did you mean role?");
    json = boxed_project();
    json["surfaces"][0]["objects"][1] = "tpo";
    refused(json, "in/p.json: surfaces[0].objects[1]: in/layers.obj has no surface tpo; it has "
                  "base, top, spare");
    json = boxed_project();
    json["surfaces"][0]["name"] = "both";
    refused(json, "in/p.json: surfaces[0].name: is for one surface, but 2 are taken from");
    json = boxed_project();
    json["surfaces"][1]["file"] = "missing.obj";
    refused(json, "missing.obj");
    json = boxed_project();
    json["surfaces"][1]["file"] = std::string("fault.obj\0x", 11);
    refused(json, "surfaces[1].file: must not have the character U+0000");
    json = boxed_project();
    json["folder"] = std::string("a\0b", 3);
    refused(json, "folder: must not have the character U+0000");
    json = boxed_project();
    json["outputs"]["certificate"] = true;
    refused(json, "in/p.json: surfaces[0].objects: a certificate is about whole files");
    json["improve"]["edge_length"] = 0.5;
    refused(
        json,
        "outputs.certificate: must be false with unit, fill, layers, tolerance, improve or depth");
    refused(boxed_project(), "not empty", 2, "-o in");
    CHECK(c.folder.run("build in/nothing.json -o out").status == 2);
}

TEST_CASE("cli: build without a conforming mesh writes nothing", "[cli]") {
    const Case c;
    c.folder.input("one.ts", "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nEND\n");
    auto json = boxed_project();
    json["surfaces"] = Json::array({{{"file", "one.ts"}}});
    const auto r = c.build(json);
    CHECK(r.status != 0);
    CHECK(c.folder.left().empty());
}

#ifdef TERRANE_HAS_TETGEN

TEST_CASE("cli: build: a certificate of tetrahedra that verify takes", "[cli]") {
    const Case c;
    auto json = boxed_project();
    json.erase("volume_of_interest");
    json["surfaces"][0].erase("objects");
    json["outputs"] = Json::parse(R"({"tetrahedra": ["vtu", "msh22"], "certificate": true})");
    const auto r = c.build(json);
    INFO(r.err);
    REQUIRE(r.status == 0);
    const auto verified = c.folder.run("verify --folder . out/certificate_tetrahedra.json");
    INFO(verified.out);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "tetrahedra_22.msh: holds these tetrahedra: every byte"));
    CHECK(contains(verified.out, "tetrahedra.vtu: holds these tetrahedra: every byte"));
}

TEST_CASE("cli: build: tetrahedra with sizes and cuts, by name", "[cli][once]") {
    const Case c;
    auto json = boxed_project();
    json["outputs"] = Json::parse(R"({"tetrahedra": ["vtu", "msh", "inp"]})");
    const auto counts = [&](const std::string& to) {
        const auto r = c.build(json, "-o " + to);
        INFO(r.err);
        REQUIRE(r.status == 0);
        return Json::parse(c.folder.read(to + "/statistics.json"))["tetrahedra"];
    };
    const auto plain = counts("plain");
    CHECK(plain["tetrahedra_of_block"][0] == 0); // there is a volume of interest
    CHECK(plain["check"]["violations"].empty());
    CHECK(plain["twin_faces"] == 0);
    json["tetrahedra"] = Json::parse(R"({"size_in": {"2": 0.7}, "split": ["fault"]})");
    const auto fine = counts("fine");
    CHECK(double(fine["tetrahedra_of_block"][2]) > 4 * double(plain["tetrahedra_of_block"][2]));
    CHECK(fine["twin_faces"] > 0);
    CHECK(fine["added_nodes"] > 0);
    const auto msh = c.folder.read("fine/tetrahedra.msh");
    CHECK(contains(msh, "\"F1 front\""));
    CHECK(contains(msh, "$Periodic"));
    CHECK(contains(msh, "\"block 2: below top, above base"));
    CHECK(contains(c.folder.read("fine/tetrahedra.inp"), "NSET=F1_PAIRS_BACK, UNSORTED"));
    // The same block is named by its name instead of its number, and the outside is filled.
    const auto name_at = msh.find("\"block 2: ") + 10;
    const auto name = msh.substr(name_at, msh.find('"', name_at) - name_at);
    json["tetrahedra"] = Json{{"size_in", Json{{name, 0.7}}}, {"split", Json::array({"F1"})}};
    CHECK(counts("named")["tetrahedra_of_block"] == fine["tetrahedra_of_block"]);
    json["tetrahedra"] = Json::parse(R"({"outside": true, "size_of": {"F1": 1}})");
    CHECK(counts("outside")["tetrahedra_of_block"][0] > 0);

    const auto refused = [&](const std::string& tetrahedra, const std::string& reason) {
        json["tetrahedra"] = Json::parse(tetrahedra);
        const auto r = c.build(json, "-o refused");
        CHECK(r.status == 2);
        CHECK(contains(r.err, reason));
    };
    refused(R"({"size_of": {"F2": 1}})", "p.json: tetrahedra.size_of.F2: no surface is called F2");
    refused(R"({"size_in": {"9": 1}})", "p.json: tetrahedra.size_in.9: no block is called 9");
    refused(R"({"split": ["F1", "x"]})", "p.json: tetrahedra.split[1]: no surface is called x");
    CHECK_FALSE(c.folder.left().contains("refused"));
}

TEST_CASE("cli: tetrahedra are made whichever standard streams are closed", "[cli]") {
    const Case c;
    const std::string fill = "tetrahedralize in/layers.obj in/fault.obj --box 0,0,0,8,8,8 -o ";
    REQUIRE(c.folder.run(fill + "a.vtu").status == 0);
    for (const std::string closed : {"<&-", ">&-", "2>&-", "<&- >&-", "<&- >&- 2>&-"}) {
        INFO(closed);
        CHECK(c.folder.shell("rm -f b.vtu; $T " + fill + "b.vtu " + closed).status == 0);
        CHECK(c.folder.shell("cmp a.vtu b.vtu").status == 0);
    }
}

TEST_CASE("cli: build gives the same bytes for any number of threads", "[cli][once]") {
    const Case c;
    auto json = boxed_project();
    json["outputs"] = Json::parse(R"({"surfaces": ["obj"], "tetrahedra": ["vtu", "inp"],
                                      "blocks": "vtp"})");
    json["improve"] = {{"edge_length", 2}};
    json["tetrahedra"] = Json::parse(R"({"edge_length": 2, "split": ["fault"]})");
    REQUIRE(c.build(json, "-o one --threads 1").status == 0);
    REQUIRE(c.build(json, "-o two --threads 2").status == 0);
    CHECK(c.folder.shell("diff -r -x log.txt -x statistics.json one two").status == 0);
}

TEST_CASE("cli: the example project", "[cli][once]") {
    const Folder folder;
    const auto r = folder.run("build $D/projects/modelA2.json -o one");
    INFO(r.err);
    REQUIRE(r.status == 0);
    const auto statistics = Json::parse(folder.read("one/statistics.json"));
    const double volume = 12000.0 * 7000 * 3700;
    CHECK(double(statistics["volumes"]["all"]) == Approx(volume));
    CHECK(statistics["tetrahedra"]["check"]["violations"].empty());
    double sum = 0;
    const auto& parts = statistics["tetrahedra"]["volume_of_block"];
    for (std::size_t i = 1; i < parts.size(); ++i) sum += double(parts[i]);
    CHECK(sum == Approx(volume));
    CHECK(statistics["tetrahedra"]["tetrahedra_of_block"][0] == 0);
    CHECK(statistics["tetrahedra"]["twin_faces"] > 0);
}

TEST_CASE("cli: tetrahedralize with sizes and cuts by name", "[cli]") {
    const Case c;
    const std::string in = "tetrahedralize in/layers.obj in/fault.obj --box 0,0,0,8,8,8 ";
    const auto r = c.folder.run(in + "-o a.msh --role fault=fault --split fault --size-of top=1 "
                                     "--size-in 2=0.8 --stats s.json");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "cut: "));
    CHECK(contains(c.folder.read("a.msh"), "\"fault front\""));
    const auto refused = [&](const std::string& arguments, const std::string& reason) {
        const auto bad = c.folder.run(in + "-o b.vtu " + arguments);
        INFO(bad.err);
        CHECK(bad.status == 2);
        CHECK(contains(bad.err, reason));
    };
    refused("--size-of top", "--size-of: needs NAME=L");
    refused("--size-of top=1m", "--size-of: needs NAME=L");
    refused("--size-of tpo=1", "--size-of: no surface is called tpo");
    refused("--size-in 77=1", "--size-in: no block is called 77");
    refused("--size-in 2=0", "--size-in: needs NAME=L, with a positive length: 2=0");
    refused("--split tpo", "--split: no surface is called tpo");
    refused("--role fault=salt", "needs NAME=ROLE");
    CHECK_FALSE(c.folder.left().contains("b.vtu"));
}

#endif

TEST_CASE("cli: without TetGen's helper, tetrahedra are refused before anything is read", "[cli]") {
    const Case c;
    auto json = boxed_project();
    json["outputs"]["tetrahedra"] = Json::array({"vtu"});
    json["surfaces"][0]["file"] = "nowhere.obj";
    c.folder.input("p.json", json.dump(2));
    const auto build = c.folder.shell("TERRANE_TETGEN=/nowhere/tetgen $T build in/p.json -o out");
    CHECK(build.status == 2);
    CHECK(build.err ==
          "terrane: in/p.json: outputs.tetrahedra: /nowhere/tetgen: is no program that "
          "can be run; the environment variable TERRANE_TETGEN names it as TetGen's "
          "helper\n");
    const auto fill =
        c.folder.shell("TERRANE_TETGEN=/etc/passwd $T tetrahedralize in/nowhere.obj -o out.vtu");
    CHECK(fill.status == 2);
    CHECK(contains(fill.err, "terrane: /etc/passwd: is no program that can be run"));
    // A copy of the program alone, as a user may make one, says where it looked for the helper.
    const auto alone = c.folder.shell("mkdir io/bin && cp $T io/bin/ && env -u TERRANE_TETGEN "
                                      "io/bin/terrane tetrahedralize in/nowhere.obj -o out.vtu");
    if (!contains(alone.err, "in/nowhere.obj")) { // unless Terrane is installed here
        CHECK(alone.status == 2);
        CHECK(contains(alone.err, "terrane: TetGen's helper program was not found; it was looked "
                                  "for as "));
        CHECK(contains(alone.err, "/io/bin/terrane-tetgen, "));
        CHECK(contains(alone.err, "/io/libexec/terrane/terrane-tetgen, "));
    }
    CHECK(c.folder.left().empty());
}

TEST_CASE("cli: build: one file named 1000 times is one surface with many names", "[cli][once]") {
    const Folder folder;
    folder.input("sheet.obj", "v 0 0 0\nv 4 0 0\nv 4 4 1\nv 0 4 0\nf 1 2 3\nf 1 3 4\n");
    folder.input("fault.obj", "v 1 -1 -2\nv 1 5 -2\nv 3 5 3\nf 1 2 3\n");
    Json project = {{"format", "terrane-project 1"}, {"outputs", {{"surfaces", {"vtp"}}}}};
    project["surfaces"] = {{{"file", "fault.obj"}}};
    for (int i = 0; i < 1000; ++i)
        project["surfaces"].push_back({{"file", "sheet.obj"}, {"name", std::to_string(i)}});
    folder.input("many.json", project.dump());
    const auto made = folder.run("build in/many.json -o out");
    INFO(made.err);
    CHECK(made.status == 0);
    const auto model = Json::parse(folder.read("out/statistics.json"));
    CHECK(model["output"]["triangles"] < 50);
}
