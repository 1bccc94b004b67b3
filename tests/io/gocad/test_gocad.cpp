// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/gocad/gocad.hpp>

#include "support/read.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr Reader parse{Format::gocad, "a.ts"};

/// Returns a TSurf with the given lines between its first line and END.
std::string tsurf(std::string_view lines) {
    return "GOCAD TSurf 1\n" + std::string(lines) + "END\n";
}

Surface one(std::string_view text) {
    const auto result = parse(text);
    REQUIRE(message_of(result) == "no error");
    REQUIRE(result.value().size() == 1);
    return result.value()[0];
}

const std::string three = "VRTX 1 0 0 1\nVRTX 2 1 0 2\nVRTX 3 0 1 3\n";

} // namespace

TEST_CASE("GOCAD: blocks, gaps, properties, trailing tokens and comments", "[io][gocad]") {
    const auto surface = one("# comment\r\nGOCAD Tsurf 1.0 \r\nHEADER {\r\n*solid*color:#808080\r\n"
                             "name:BLAH 12\r\nfoo:bar\r\n}\r\nPROPERTIES Z\r\n"
                             "PROPERTY_CLASS_HEADER Z {\r\nname: not this\r\nis_z:on\r\n}\r\n"
                             "GEOLOGICAL_TYPE fault\r\nTFACE\r\nVRTX 7 1 2 3 CNXYZ\r\n"
                             "PVRTX 9 +4 5.5D+01 6d0 -99999\r\nVRTX 3 7 8 9\r\nTRGL 7 9 3 0\r\n"
                             "TFACE 2\r\nATOM 20 9\r\nPATOM 21 3 1.5\r\nVRTX 22 0 0 0\r\n"
                             "TRGL 20 21 22\r\nBSTONE 7\r\nBORDER 30 7 9\r\nEND\r\n");
    CHECK(surface.name == "BLAH 12");
    CHECK(surface.role == Role::fault);
    CHECK(surface.vertices == std::vector<Point3>{{1, 2, 3}, {4, 55, 6}, {7, 8, 9}, {0, 0, 0}});
    CHECK(surface.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}});
}

TEST_CASE("GOCAD: names", "[io][gocad]") {
    const std::pair<const char*, const char*> cases[] = {
        {"HEADER {\nname: \"Blah 1 2\"\n}\n", "Blah 1 2"},
        {"HEADER {\nNAME:x/3  \n}\n", "x/3"},
        {"HEADER {\n  name = mnt\n}\n", "mnt"},
        {"HEADER {name:one line}\n", "one line"},
        {"HEADER{\nname:tight\n}\n", "tight"},
        {"HEADER {\nname:unclosed\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\n"
         "ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n",
         "unclosed"},
        {"HEADER {\n}\n", "a"},
        {"", "a"},
    };
    for (const auto& [header, name] : cases)
        CHECK(one(tsurf(header + three + "TRGL 1 2 3\n")).name == name);
}

TEST_CASE("GOCAD: z points up", "[io][gocad]") {
    const std::string body = "TFACE\nVRTX 1 1 2 0\nVRTX 2 3 4 5\nVRTX 3 6 7 -8\nTRGL 1 2 3\n";
    const auto up = one(tsurf("ZPOSITIVE Elevation\n" + body));
    const auto down = one(tsurf("ZPOSITIVE Depth \n" + body));
    CHECK(same_bits(up.vertices, {{1, 2, 0}, {3, 4, 5}, {6, 7, -8}}));
    CHECK(same_bits(down.vertices, {{1, 2, 0}, {3, 4, -5}, {6, 7, 8}}));
    CHECK(down.triangles == up.triangles);
    CHECK(same_bits(one(tsurf(body)).vertices, up.vertices));
}

TEST_CASE("GOCAD: ids may be used before they are defined", "[io][gocad]") {
    const auto surface = one(tsurf("TRGL 4 5 3\nATOM 4 5\nATOM 5 1\nVRTX 1 0 0 1\nVRTX 3 0 1 3\n"));
    CHECK(surface.vertices.size() == 2);
    CHECK(surface.triangles == std::vector<Triangle>{{0, 0, 1}});
}

TEST_CASE("GOCAD: ids count per object, other objects are passed over", "[io][gocad]") {
    const auto result = parse("GOCAD HeterogeneousGroup 1\nHEADER {\nname:g\n}\nBEGIN_MEMBERS\n" +
                              tsurf("HEADER {\nname:x\n}\n" + three + "TRGL 1 2 3\n") +
                              "GOCAD PLine 1\nILINE\nVRTX 1 0 0 0\nSEG 1 2\nEND\n" +
                              tsurf("HEADER {\nname:y\n}\n" + three + "TRGL 3 2 1\n") + tsurf("") +
                              "END_MEMBERS\nEND\n");
    REQUIRE(message_of(result) == "no error");
    REQUIRE(result.value().size() == 3);
    CHECK(result.value()[0].name == "x");
    CHECK(result.value()[1].triangles == std::vector<Triangle>{{2, 1, 0}});
    CHECK(result.value()[2].triangles.empty());
}

TEST_CASE("GOCAD: roles", "[io][gocad]") {
    const std::pair<const char*, Role> cases[] = {
        {"top", Role::horizon},         {"unconformity", Role::horizon},
        {"topographic", Role::horizon}, {"Fault", Role::fault},
        {"reverse_fault", Role::fault}, {"boundary", Role::boundary},
        {"intrusive", Role::unknown},   {"\"fault\"", Role::fault},
    };
    for (const auto& [type, role] : cases)
        CHECK(one(tsurf("GEOLOGICAL_TYPE " + std::string(type) + "\n" + three + "TRGL 1 2 3\n"))
                  .role == role);
}

TEST_CASE("GOCAD: broken files", "[io][gocad]") {
    const auto units = tsurf("AXIS_UNIT \"m\" \"m\" \"m\"\n" + three + "TRGL 1 2 3\n") +
                       tsurf("AXIS_UNIT km km km\n");
    using enum ErrorCode;
    const Broken cases[] = {
        {"", bad_syntax, "a.ts: not a GOCAD file: no line begins with GOCAD"},
        {"v 0 0 0\n", bad_syntax, "a.ts: not a GOCAD file: no line begins with GOCAD"},
        {"GOCAD PLine 1\nEND\nGOCAD VSet 1\nEND\nGOCAD VSet 1\nEND\n", nothing_to_do,
         "a.ts: there is no TSurf, only 1 PLine, 2 VSet; --input-format vs connects their points"},
        {"PK\3\4mesh\n", unsupported,
         "a.ts: this is a ZIP archive, as RINGMesh writes with the extension .gm; save the model "
         "as .ml or its surfaces as .ts"},
        {"GOCAD\n", nothing_to_do, "a.ts: there is no TSurf, only 1 object without a type"},
        {"GOCAD TSurf 1\nTFACE\nEND\n", nothing_to_do, "a.ts: there is no triangle"},
        {"GOCAD TSurf 1\nVRTX 1 0 0 0\n", bad_syntax,
         "a.ts:2: the object that begins in line 1 has no END"},
        {"GOCAD TSurf 1\nTFACE\nGOCAD TSurf 1\nEND\n", bad_syntax,
         "a.ts:3: the object that begins in line 1 has no END"},
        {"GOCAD TSurf 1\nHEADER {\nname:x\n", bad_syntax,
         "a.ts:3: the object that begins in line 1 has no END"},
        {"GOCAD TSurf 1\nVRTX 1 0 0\nEND\n", bad_syntax, "a.ts:2: VRTX needs 3 numbers"},
        {"GOCAD TSurf 1\nPVRTX\nEND\n", bad_syntax, "a.ts:2: PVRTX needs an id"},
        {"GOCAD TSurf 1\nVRTX x 0 0 0\nEND\n", bad_syntax, "a.ts:2: \"x\" is not an id"},
        {"GOCAD TSurf 1\nVRTX -1 0 0 0\nEND\n", bad_syntax, "a.ts:2: \"-1\" is not an id"},
        {"GOCAD TSurf 1\nVRTX 1 0 0 blah\nEND\n", bad_syntax, "a.ts:2: \"blah\" is not a number"},
        {"GOCAD TSurf 1\nVRTX 1 0 1.#INF 0\nEND\n", bad_number,
         "a.ts:2: \"1.#INF\" is not a finite number"},
        {"GOCAD TSurf 1\nVRTX 1 0 1D400 0\nEND\n", bad_number,
         "a.ts:2: \"1D400\" does not fit in a double"},
        {"GOCAD TSurf 1\nVRTX 1 0 0 0\nVRTX 1 0 0 0\nEND\n", bad_syntax,
         "a.ts:3: vertex 1 is defined twice"},
        {"GOCAD TSurf 1\nATOM 1 9\nVRTX 1 0 0 0\nEND\n", bad_syntax,
         "a.ts:3: vertex 1 is defined twice"},
        {"GOCAD TSurf 1\nATOM 1 9\nATOM 1 8\nEND\n", bad_syntax,
         "a.ts:3: vertex 1 is defined twice"},
        {"GOCAD TSurf 1\nATOM 1\nEND\n", bad_syntax, "a.ts:2: ATOM needs 2 ids"},
        {"GOCAD TSurf 1\nTRGL 1 2\nEND\n", bad_syntax, "a.ts:2: TRGL needs 3 ids"},
        {"GOCAD TSurf 1\nVRTX 1 0 0 0\nTRGL 1 1 59\nEND\n", bad_index,
         "a.ts:3: vertex 59 is not defined in this object"},
        {"GOCAD TSurf 1\nATOM 1 2\nEND\n", bad_index,
         "a.ts:2: vertex 2 is not defined in this object"},
        {"GOCAD TSurf 1\nATOM 1 2\nATOM 2 1\nEND\n", bad_index, "a.ts:2: ATOM 1 refers to itself"},
        {"GOCAD TSurf 1\nZPOSITIVE Up\nEND\n", bad_syntax,
         "a.ts:2: ZPOSITIVE must be Elevation or Depth, not \"Up\""},
        {units, unsupported,
         "a.ts:8: AXIS_UNIT is \"km km km\", but \"m m m\" for the object in line 1"},
    };
    for (const auto& [text, code, message] : cases) {
        const auto result = parse(text);
        CHECK(message_of(result) == message);
        if (!result) CHECK(result.error().code == code);
    }
}

TEST_CASE("GOCAD: a long chain of atoms ahead of their vertex is quick", "[io][gocad]") {
    std::string text = "GOCAD TSurf 1\n";
    constexpr int count = 100000;
    for (int i = 1; i < count; ++i)
        text += "ATOM " + std::to_string(i) + ' ' + std::to_string(i + 1) + '\n';
    text += "VRTX " + std::to_string(count) + " 1 2 3\nTRGL 1 2 3\nEND\n";
    CHECK(one(text).triangles == std::vector<Triangle>{{0, 0, 0}});
}

TEST_CASE("GOCAD: written and read back", "[io][gocad]") {
    auto mesh = awkward_mesh();
    mesh.surfaces[2].name = " with blanks around ";
    const auto result = parse(to_gocad(mesh));
    REQUIRE(message_of(result) == "no error");
    const auto expected = split(mesh);
    REQUIRE(result.value().size() == expected.size());
    for (std::size_t s = 0; s < expected.size(); ++s) {
        CHECK(result.value()[s].name == expected[s].name);
        CHECK(result.value()[s].role == expected[s].role);
        CHECK(same_bits(result.value()[s].vertices, expected[s].vertices));
        CHECK(result.value()[s].triangles == expected[s].triangles);
    }
}
