// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests --certificate of `terrane volume` and `terrane tetrahedralize`, and `terrane verify` with
// it.
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/effort.hpp"

using namespace program_test;

namespace {

/// Changes the first digit behind a place in a file.
void change_digit(const Folder& folder, const std::string& file, const std::string& behind) {
    REQUIRE(folder.shell("sed -i -E '0,/" + behind + "[0-9]/s/(" + behind + ")[0-8]/\\19/' " + file)
                .status == 0);
}

} // namespace

TEST_CASE("cli: volume: a certificate that verify takes", "[cli][once]") {
    const Folder folder;
    std::vector<std::string> names{"ringmesh/modelA1.ml"};
    if (!test_support::is_sanitized) names.emplace_back("arch-platform/faults.ts");
    for (const std::string& name : names) {
        INFO(name);
        const auto made =
            folder.run("volume $D/" + name + " -o model --parts obj --certificate blocks.json");
        INFO(made.err);
        REQUIRE(made.status == 0);
        CHECK(contains(made.out, "wrote model\nwrote blocks.json\n"));
        const auto verified = folder.run("verify --folder / blocks.json");
        INFO(verified.out);
        CHECK(verified.status == 0);
        CHECK(contains(verified.out, " with their exact volumes\n"));
        CHECK(contains(verified.out, "model/model.json: holds these blocks, interfaces, patches, "
                                     "lines and corners, and names, "));
        CHECK(contains(verified.out,
                       "model/interfaces/interface_0.obj: holds these triangles: every byte\n"));
        const auto json = Json::parse(folder.run("verify --folder / --json blocks.json").out);
        CHECK(json["blocks"] == Json::parse(folder.read("model/model.json"))["blocks"].size() - 1);
        change_digit(folder, "model/interfaces/interface_0.obj", "v .*[.]");
        CHECK(folder.run("verify --folder / blocks.json").status == 1);
        REQUIRE(folder.shell("rm -r model blocks.json").status == 0);
    }
}

TEST_CASE("cli: verify: each input file is read in the format of its own name", "[cli]") {
    const Folder folder;
    const std::string in = "$D/ringmesh/modelA1.ml";
    REQUIRE(folder.run("arrange " + in + " -o out.vtp -o out.obj --certificate c.json").status ==
            0);
    CHECK(folder.run("verify --folder / c.json " + in).status == 0);
    REQUIRE(folder.shell("cp " + in + " same.gp && cp " + in + " other.obj").status == 0);
    CHECK(folder.run("verify --folder / c.json same.gp").status == 0);
    CHECK(folder.run("verify --folder / c.json other.obj").status == 2);
    CHECK(folder.run("verify --folder / c.json other.obj --input-format ml").status == 0);
}

TEST_CASE("cli: verify: all output files are judged, also those that are not named", "[cli]") {
    const Folder folder;
    REQUIRE(folder.run("arrange $D/ringmesh/modelA1.ml -o out.vtp -o out.obj --certificate c.json")
                .status == 0);
    change_digit(folder, "out.obj", "v .*[.]");
    CHECK(folder.run("verify --folder / c.json --output out.vtp").status == 1);
    REQUIRE(folder.shell("rm out.obj").status == 0);
    CHECK(folder.run("verify --folder / c.json --output out.vtp").status == 2);
}

TEST_CASE("cli: a certificate of blocks: what it cannot be about", "[cli]") {
    const Folder folder;
    const std::string in = "$D/ringmesh/modelA1.ml";
    for (const std::string options : {"--certificate -", "--certificate no/folder/c"}) {
        INFO(options);
        CHECK(folder.run("volume " + in + " -o model " + options).status == 2);
        CHECK(folder.run("tetrahedralize " + in + " -o model.vtu " + options).status == 2);
    }
    CHECK(folder.run("volume --format ml - -o model --certificate c < " + in).status == 2);
    CHECK(folder.run("tetrahedralize " + in + " --format vtu -o - --certificate c").status == 2);
    CHECK(folder.left().empty());
}

TEST_CASE("cli: tetrahedralize: a certificate that verify takes", "[cli][tetrahedra][once]") {
    const Folder folder;
    const auto made =
        folder.run("tetrahedralize $D/ringmesh/modelA1.ml -o m.vtu -o m.msh -o m.mesh "
                   "--certificate tetrahedra.json");
    INFO(made.err);
    if (contains(made.err, "terrane-tetgen")) return; // TetGen was not built
    REQUIRE(made.status == 0);
    const auto verified = folder.run("verify --folder / tetrahedra.json");
    INFO(verified.out);
    CHECK(verified.status == 2); // the verifier does not write MEDIT
    CHECK(contains(verified.out, "m.vtu: holds these tetrahedra: every byte, once decompressed\n"));
    CHECK(contains(verified.out, "m.msh: holds these tetrahedra: every byte\n"));
    CHECK(folder.run("verify --folder / tetrahedra.json --output m.vtu --output m.msh").status ==
          2); // m.mesh by its hash alone
    change_digit(folder, "m.msh", "^[0-9]+ [0-9]+ [0-9]+ [0-9]+ ");
    CHECK(folder.run("verify --folder / tetrahedra.json --output m.vtu --output m.msh").status ==
          1);
}
