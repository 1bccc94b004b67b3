// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Models, lines and points for GOCAD, from outside.
#include <map>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Returns the volumes between the written doubles by the names of blocks.
std::map<std::string, double> written_volumes(const std::string& model) {
    std::map<std::string, double> volumes;
    const auto json = Json::parse(model);
    for (const auto& block : json["blocks"])
        volumes[block["name"]] = block.value("volume_written", 0.0);
    return volumes;
}

} // namespace

TEST_CASE("cli: a model for GOCAD gives the same blocks when it is read again",
          "[cli][gocad][once]") {
    const Folder folder;
    const auto r = folder.run("volume $D/ringmesh/modelA2.ml -o one --gocad m.ml --lines lines.pl");
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(contains(r.out, "wrote m.ml\nwrote lines.pl\n"));
    REQUIRE(folder.run("volume m.ml -o two --gocad n.ml").status == 0);
    const auto before = written_volumes(folder.read("one/model.json"));
    CHECK(before.size() == 13);
    CHECK(before.contains("Top_Region_7"));
    CHECK(written_volumes(folder.read("two/model.json")) == before);
    CHECK(contains(folder.read("lines.pl"), "\nname: cutoff line of "));
    CHECK(folder.run("convert --max-edge 1e9 lines.pl lines.obj").status == 0);
    // A conforming mesh does not change.
    REQUIRE(folder.run("volume n.ml -o three --gocad o.ml").status == 0);
    CHECK(written_volumes(folder.read("three/model.json")) == before);
}

TEST_CASE("cli: a .ml of surfaces says that it has no regions", "[cli][gocad]") {
    const Folder folder;
    const auto in = folder.input("crossing.obj", crossing);
    const std::string sentence =
        "wrote x.ml: surfaces without regions, which terrane volume --gocad writes\n";
    const auto arranged = folder.run("arrange " + in + " -o x.ml -o x.ts");
    REQUIRE(arranged.status == 0);
    CHECK(contains(arranged.out, sentence + "wrote x.ts\n"));
    CHECK(folder.read("x.ml") == folder.read("x.ts"));
    CHECK(folder.run("convert " + in + " x.ml").out == sentence);
    CHECK(folder.run("convert " + in + " x.ts").out.empty());
}

TEST_CASE("cli: borders, intersection curves and vertices of an arrangement", "[cli][gocad]") {
    const Folder folder;
    const auto in = folder.input("crossing.obj", crossing);
    const auto r = folder.run("arrange " + in + " -o c.pl -o v.vs");
    INFO(r.err);
    REQUIRE(r.status == 0);
    const auto curves = folder.read("c.pl"), points = folder.read("v.vs");
    for (const char* name :
         {"name: horizon border\n", "name: fault border\n", "name: horizon and fault\n"})
        CHECK(contains(curves, name));
    CHECK(contains(points, "GOCAD VSet 1\nHEADER {\nname: horizon\n"));
    CHECK(folder.run("convert --max-edge 100 v.vs back.ts").status == 0);
    CHECK(folder.run("convert --max-edge 100 c.pl back.ts").status == 0);
    // A closed surface has neither.
    const auto closed = folder.run("convert $D/arrangements/three_cubes.stl none.pl");
    CHECK(closed.status == 2);
    CHECK(contains(closed.err, "none.pl: there is no line: no border and no intersection"));
    const auto proof = folder.run("arrange " + in + " -o c.pl --certificate c.json");
    CHECK(proof.status == 2);
    CHECK(contains(proof.err, "c.pl: a certificate cannot be about a file in this format"));
    CHECK(folder.run("volume " + in + " -o out --lines no/l.pl").status == 2);
}
