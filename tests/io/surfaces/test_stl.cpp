// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <limits>

#include <terrane/io/surfaces/stl.hpp>
#include <terrane/io/text/bytes.hpp>

#include "support/read.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr Reader parse_stl{Format::stl, "a.stl"};

/// Returns a binary STL file with the given header and three corners per triangle.
std::string binary(std::string header, const std::vector<float>& coordinates) {
    header.resize(80, ' ');
    detail::store(header, static_cast<std::uint32_t>(coordinates.size() / 9));
    for (std::size_t i = 0; i < coordinates.size(); i += 9) {
        header.append(12, '\xFF'); // the normal: NaN, which is not read
        for (std::size_t k = 0; k < 9; ++k) detail::store(header, coordinates[i + k]);
        detail::store(header, std::uint16_t(7));
    }
    return header;
}

constexpr std::string_view facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                   "vertex 0 1 0\nendloop\nendfacet\n";

} // namespace

TEST_CASE("STL: equal corners are one vertex, also in a binary file that begins with solid",
          "[io][stl]") {
    const std::vector<float> two{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, -0.0f, 1, 0, 0, 0.1f, 1, 1};
    for (const auto* header : {"", "solid trap"}) {
        const auto result = parse_stl(binary(header, two));
        REQUIRE(message_of(result) == "no error");
        const auto& surface = result.value().at(0);
        CHECK(surface.name == "a");
        CHECK(same_bits(surface.vertices, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1f, 1, 1}}));
        CHECK(surface.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
    }
}

TEST_CASE("STL: several ASCII solids, in any layout", "[io][stl]") {
    const auto text = "solid top of reservoir\n" + std::string(facet) +
                      "endsolid top\nsolid none\n" +
                      "endsolid none\r\nSOLID\nFACET NORMAL nan 0 0 OUTER LOOP VERTEX 0 0 +1 "
                      "vertex 1e-400 0 1 VERTEX 1 1 1 ENDLOOP ENDFACET\nENDSOLID\n";
    const auto result = parse_stl(text);
    REQUIRE(message_of(result) == "no error");
    REQUIRE(result.value().size() == 2);
    CHECK(result.value()[0].name == "top of reservoir");
    CHECK(result.value()[0].vertices.size() == 3);
    CHECK(result.value()[1].name == "a");
    CHECK(result.value()[1].triangles == std::vector<Triangle>{{0, 0, 1}});
}

TEST_CASE("STL: broken files", "[io][stl]") {
    using enum ErrorCode;
    const auto whole = binary("", std::vector<float>(9, 1.0f));
    auto claims = binary("", {});
    claims.replace(80, 4, "\xFF\xFF\xFF\xFF");
    const auto infinite =
        binary("", {0, 0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0, 0});
    const auto open = "solid\n" + std::string(facet);
    const Broken cases[] = {
        {"", bad_syntax, "a.stl: neither ASCII nor binary STL"},
        {"hello", bad_syntax, "a.stl: neither ASCII nor binary STL"},
        {std::string_view(whole).substr(0, 100), bad_syntax,
         "a.stl, byte 80: 1 triangles call for 134 bytes, but the file has 100"},
        {claims, bad_syntax,
         "a.stl, byte 80: 4294967295 triangles call for 214748364834 bytes, but the file has 84"},
        {infinite, bad_number, "a.stl, byte 112: the coordinate is not a finite number"},
        {"solid x\nendsolid x\n", nothing_to_do, "a.stl: there is no facet"},
        {open, bad_syntax, "a.stl:8: expected endsolid, found the end of the file"},
        {"solid\nfacets\n", bad_syntax, "a.stl:2: expected facet, found \"facets\""},
        {"solid\nfacet\n", bad_syntax, "a.stl:2: expected outer, found the end of the file"},
        {"solid\nfacet\nouter loop\nvertex 0 0\nvertex\n", bad_syntax,
         "a.stl:5: \"vertex\" is not a number"},
        {"solid\nfacet\nouter loop\nvertex 0 0\n", bad_syntax, "a.stl:4: vertex needs 3 numbers"},
        {"solid\nfacet\nouter loop\nvertex 0 0 nan\n", bad_number,
         "a.stl:4: \"nan\" is not a finite number"},
        {"solid\nfacet\nouter loop\nvertex 0 0 0\nendloop\n", bad_syntax,
         "a.stl:5: expected vertex, found \"endloop\""},
        {"solid\nendsolid\nvertex\n", bad_syntax, "a.stl:3: expected solid, found \"vertex\""},
    };
    for (const auto& [text, code, message] : cases) {
        const auto result = parse_stl(text);
        CHECK(message_of(result) == message);
        if (!result) CHECK(result.error().code == code);
    }
    CHECK(message_of(parse_stl(binary("", {}))) == "a.stl: there is no facet");
}

TEST_CASE("STL: written and read back", "[io][stl]") {
    const auto mesh = float_mesh();
    const auto bytes = to_stl(mesh);
    REQUIRE(bytes);
    CHECK(bytes.value().substr(0, 39) == "Terrane: coordinates rounded to float32");
    const auto result = parse_stl(bytes.value());
    REQUIRE(message_of(result) == "no error");
    const auto& surface = result.value().at(0);
    REQUIRE(surface.triangles.size() == mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(same_bits(surface.vertices[surface.triangles[t][k]],
                            mesh.vertices[mesh.triangles[t][k]]));
}

TEST_CASE("STL: doubles are rounded to float32, or refused", "[io][stl]") {
    auto mesh = float_mesh();
    mesh.vertices[1].x = 4234567.123456789;
    const auto rounded = parse_stl(to_stl(mesh).value());
    REQUIRE(rounded);
    CHECK(rounded.value()[0].vertices[1].x == 4234567.0);
    mesh.vertices[2].y = -1e300;
    const auto refused = to_stl(mesh);
    CHECK(message_of(refused) == "vertex 2: -1e+300 does not fit in the float32 of STL");
    CHECK(refused.error().code == ErrorCode::bad_number);
}

TEST_CASE("STL: ASCII keeps surfaces and doubles", "[io][stl]") {
    const auto mesh = awkward_mesh();
    const auto result = parse_stl(to_stl_ascii(mesh));
    REQUIRE(message_of(result) == "no error");
    REQUIRE(result.value().size() == 3);
    CHECK(result.value()[1].name == "main_\"A\"_fault");
    const auto expected = split(mesh);
    for (std::size_t s = 0; s < 3; ++s) {
        const auto& surface = result.value()[s];
        REQUIRE(surface.triangles.size() == expected[s].triangles.size());
        for (std::size_t t = 0; t < surface.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(same_bits(surface.vertices[surface.triangles[t][k]],
                                expected[s].vertices[expected[s].triangles[t][k]]));
    }
}
