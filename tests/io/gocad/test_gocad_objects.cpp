// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

#include "support/paths.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

const std::filesystem::path data = test_data();

GocadModel model_of(const char* name) {
    const auto result = read_model(data / "ringmesh" / name);
    REQUIRE(message_of(result) == "no error");
    return result.value();
}

std::string model3d(std::string_view lines) {
    return "GOCAD Model3d 1\nHEADER {\nname:m\n}\n" + std::string(lines) + "END\n";
}

const std::string box_tsurf = "GOCAD TSurf 1\nHEADER {\nname:my box\n}\nTFACE\nVRTX 1 0 0 0\n"
                              "TRGL 1 1 1\nTFACE\nTRGL 1 1 1\nTRGL 1 1 1\nEND\n";

const std::string lists = "TSURF my box\nTFACE 1 boundary my box\n 0 0 0\n 1 1 1\n 2 2 2\n"
                          "TFACE 2 fault \"my box\"\n 0 0 0\n 1 1 1\n 2 2 2\n";

} // namespace

TEST_CASE("GOCAD models: parts, regions and layers", "[io][gocad]") {
    const auto result = read_gocad_model(model3d(lists + "REGION 3 Universe\n -1 \n -2 0\n"
                                                         "REGION 4 in side \n +1 +2 0\n"
                                                         "LAYER one \n 4 0\n") +
                                             box_tsurf,
                                         "a.ml", "a");
    REQUIRE(message_of(result) == "no error");
    const auto& model = result.value();
    CHECK(model.name == "m");
    REQUIRE(model.surfaces.size() == 1);
    CHECK(model.surfaces[0].name == "my box");
    CHECK(model.surfaces[0].role == Role::boundary);
    REQUIRE(model.parts.size() == 2);
    CHECK(model.parts[1].feature == "fault");
    CHECK(model.parts[1].first_triangle == 1);
    CHECK(model.parts[1].triangle_count == 2);
    REQUIRE(model.regions.size() == 2);
    CHECK(model.regions[1].name == "in side");
    CHECK(model.regions[0].sides == std::vector<ModelSide>{{0, false}, {1, false}});
    REQUIRE(model.layers.size() == 1);
    CHECK(model.layers[0].regions == std::vector<std::uint32_t>{4});
}

TEST_CASE("GOCAD models: the regions that are stated", "[io][gocad]") {
    const auto result = read_gocad_model(
        model3d(lists + "REGION 3 universe\n -1 \n 0\nREGION 4 in side\n +1 -2 +2 0\n"
                        "REGION 5 other\n +2 0\nLAYER one\n 4 0\nLAYER two\n 4 5 0\n") +
            box_tsurf,
        "a.ml", "a");
    REQUIRE(message_of(result) == "no error");
    const auto regions = stated_blocks_of(result.value());
    REQUIRE(regions.size() == 2);
    CHECK(regions[0].name == "in side");
    CHECK(regions[0].layer == "one");
    CHECK(regions[0].borders == std::vector<StatedBorder>{{SurfaceId(0), 0, 1}}); // TFACE 2 dangles
    CHECK(regions[1].layer == "two");
    CHECK(regions[1].borders == std::vector<StatedBorder>{{SurfaceId(0), 1, 2}});
    CHECK(read_stated_blocks(data / "ringmesh" / "modelA2.ml").size() == 12);
    CHECK(read_stated_blocks("/there/is/no/file.ml").empty());
    std::vector<StatedBlock> all;
    append_stated_blocks(regions, 3, all);
    CHECK(all[1].borders == std::vector<StatedBorder>{{SurfaceId(3), 1, 2}});
}

TEST_CASE("GOCAD models: broken files", "[io][gocad]") {
    using enum ErrorCode;
    const auto named = model3d("TSURF other\n") + box_tsurf;
    const auto part = model3d("TFACE 1 fault other\n") + box_tsurf;
    const auto short_part = model3d("TFACE 1 fault\n") + box_tsurf;
    const auto no_id = model3d("TFACE x fault my box\n") + box_tsurf;
    const auto few = model3d("TFACE 1 fault my box\n") + box_tsurf;
    const auto many = model3d(lists + "TFACE 3 fault my box\n") + box_tsurf;
    const auto twice = model3d("TFACE 1 fault my box\nTFACE 1 fault my box\n") + box_tsurf;
    const auto region = model3d(lists + "REGION 5 R\n +1 -7 0\n") + box_tsurf;
    const auto layer = model3d(lists + "LAYER L\n 9 0\n") + box_tsurf;
    const auto list = model3d(lists + "REGION 5 R\n +1\n");
    const auto endless = "GOCAD Model3d 1\nREGION 5 R\n 1 2\n";
    const Broken cases[] = {
        {box_tsurf, nothing_to_do, "a.ml: there is no Model3d"},
        {"GOCAD Model3d 1\nEND\n", nothing_to_do, "a.ml: there is no TSurf, only 1 Model3d"},
        {"GOCAD Model3d 1\n", bad_syntax, "a.ml:1: the object that begins in line 1 has no END"},
        {named, bad_syntax,
         "a.ml:1: the model names surface \"other\", which is no TSurf of the file"},
        {part, bad_syntax, "a.ml:5: TFACE 1 is part of \"other\", which is no TSurf of the file"},
        {short_part, bad_syntax,
         "a.ml:5: TFACE needs an id, a feature type and the name of a surface"},
        {no_id, bad_syntax, "a.ml:5: expected an id, found \"x\""},
        {few, bad_syntax, "a.ml:7: the model does not list the 2 TFACE of surface \"my box\""},
        {many, bad_syntax, "a.ml:14: the model does not list the 2 TFACE of surface \"my box\""},
        {twice, bad_syntax, "a.ml:6: TFACE 1 is listed twice"},
        {region, bad_index, "a.ml:14: region 5 names TFACE -7, which does not exist"},
        {layer, bad_index, "a.ml:1: layer \"L\" names region 9, which does not exist"},
        {list, bad_syntax, "a.ml:16: \"END\" in a list of ids that ends with 0"},
        {endless, bad_syntax, "a.ml:2: the list of ids does not end with 0"},
    };
    for (const auto& [text, code, message] : cases) {
        const auto result = read_gocad_model(text, "a.ml", "a");
        CHECK(message_of(result) == message);
        if (!result) CHECK(result.error().code == code);
    }
}

TEST_CASE("GOCAD models: RINGMesh's A1 and A2", "[io][gocad]") {
    const auto a1 = model_of("modelA1.ml");
    CHECK(a1.name == "modelA1");
    CHECK(a1.surfaces.size() == 9);
    CHECK(a1.parts.size() == 21);
    CHECK(a1.regions.size() == 5);
    const auto a2 = model_of("modelA2.ml");
    CHECK(a2.surfaces.size() == 6);
    CHECK(a2.parts.size() == 61);
    CHECK(a2.regions.size() == 13);
    for (const auto& model : {a1, a2}) {
        CHECK(model.regions[0].name == "Universe");
        std::size_t sides = 0;
        for (const auto& region : model.regions) sides += region.sides.size();
        CHECK(sides == 2 * model.parts.size()); // no surface of these models dangles
        std::size_t triangles = 0;
        for (const auto& part : model.parts) triangles += part.triangle_count;
        for (const auto& surface : model.surfaces) triangles -= surface.triangles.size();
        CHECK(triangles == 0);
    }
    const auto surfaces = read_surfaces(data / "ringmesh/modelA2.ml").value();
    CHECK(surfaces[0].role == Role::boundary);
    CHECK(surfaces[1].role == Role::fault);
    CHECK(surfaces[3].role == Role::horizon);
}
