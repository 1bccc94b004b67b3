// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/surfaces/off.hpp>

#include "support/read.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr Reader parse_off{Format::off, "a.off"};
} // namespace

TEST_CASE("OFF: all headers and further columns", "[io][off]") {
    for (const auto* text :
         {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
          "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
          "# made by\r\n\r\nCOFF # colours\r\n3 1 0\r\n0 0 0 255 0 0 255\r\n1 0 0 1 1 1\r\n"
          "# half way\r\n0 1 0 1 1 1\r\n3 0 1 2 0.5 0.5 0.5\r\n\r\n# end\r\n",
          "STCNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 9 0 0\n1 0 0 0 0 1 9 9 9 9 0 0\n"
          "0 1 0 0 0 1 9 9 9 9 0 0\n3 0 1 2\n"}) {
        const auto result = parse_off(text);
        REQUIRE(message_of(result) == "no error");
        const auto& surface = result.value().at(0);
        CHECK(surface.name == "a");
        CHECK(surface.vertices == std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(surface.triangles == std::vector<Triangle>{{0, 1, 2}});
    }
}

TEST_CASE("OFF: polygons become fans, unused vertices stay", "[io][off]") {
    const auto result =
        parse_off("OFF\n6 1 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n9 9 9\n5 0 1 2 3 4\n");
    REQUIRE(result);
    CHECK(result.value()[0].triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
    CHECK(result.value()[0].vertices.size() == 6);
}

TEST_CASE("OFF: broken files", "[io][off]") {
    using enum ErrorCode;
    const Broken cases[] = {
        {"", nothing_to_do, "a.off: the file is empty"},
        {"OFF\n3 0 0\n0 0 0\n0 0 0\n0 0 0\n", nothing_to_do, "a.off: there is no face"},
        {"OFF\n", bad_syntax, "a.off:1: the counts are missing"},
        {"OFF\n-3 1 0\n", bad_syntax,
         "a.off:2: expected the numbers of vertices and faces, found \"-3 1 0\""},
        {"hello\n", bad_syntax,
         "a.off:1: expected the numbers of vertices and faces, found \"hello\""},
        {"XOFF\n3 1 0\n", bad_syntax, "a.off:1: \"XOFF\" is not an OFF keyword"},
        {"4OFF\n3 1 0\n", unsupported, "a.off:1: 4OFF: vertices do not have 3 coordinates"},
        {"nOFF\n3 1 0\n", unsupported, "a.off:1: nOFF: vertices do not have 3 coordinates"},
        {"OFF BINARY\n", unsupported, "a.off:1: binary OFF is not read"},
        {"OFF\n4000000000 4000000000 0\n0 0 0\n", bad_syntax,
         "a.off:3: the file ends after 1 of 4000000000 vertices"},
        {"OFF\n1 4000000000 0\n0 0 0\n3 0 0 0\n", bad_syntax,
         "a.off:4: the file ends after 1 of 4000000000 faces"},
        {"OFF\n1 1 0\n0 0\n", bad_syntax, "a.off:3: a vertex needs 3 numbers"},
        {"OFF\n1 1 0\n0 0 inf\n", bad_number, "a.off:3: \"inf\" is not a finite number"},
        {"OFF\n1 1 0\n0 0 0\n2 0 0\n", bad_syntax,
         "a.off:4: a face begins with its number of corners, at least 3: \"2 0 0\""},
        {"OFF\n1 1 0\n0 0 0\n4000000000 0 0 0\n", bad_syntax,
         "a.off:4: the face has fewer corners than it says"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0 0.5\n", bad_syntax, "a.off:4: \"0.5\" is not a vertex number"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0 1\n", bad_index,
         "a.off:4: the face names vertex 1, which does not exist: there are 1, counted from 0"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", bad_index,
         "a.off:4: the face names vertex -1, which does not exist: there are 1, counted from 0"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0 0\n3 0 0 0\n", bad_syntax,
         "a.off:5: there is more than the 1 faces stated"},
    };
    for (const auto& [text, code, message] : cases) {
        const auto result = parse_off(text);
        CHECK(message_of(result) == message);
        if (!result) CHECK(result.error().code == code);
    }
}

TEST_CASE("OFF: written and read back", "[io][off]") {
    const auto mesh = awkward_mesh();
    const auto result = parse_off(to_off(mesh));
    REQUIRE(message_of(result) == "no error");
    CHECK(same_bits(result.value()[0].vertices, mesh.vertices));
    CHECK(result.value()[0].triangles == mesh.triangles);
}
