// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>

#include <terrane/io/files.hpp>

using namespace terrane;

namespace {

const std::string dxf_entities = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n"
                                 "0\nSECTION\n2\nENTITIES\n";
const std::string dxf_triangle = "0\n3DFACE\n8\ntop\n10\n0\n20\n0\n30\n1\n11\n2\n21\n0\n31\n1\n"
                                 "12\n0\n22\n2\n32\n1.5\n13\n0\n23\n2\n33\n1.5\n";
const std::string dxf_square =
    "  0\r\n3DFACE\r\n  8\r\nfault 1\r\n 10\r\n0.0\r\n 20\r\n0.0\r\n 30\r\n"
    "0.0\r\n 11\r\n1.0\r\n 21\r\n0.0\r\n 31\r\n0.0\r\n 12\r\n1.0\r\n 22\r\n"
    "1.0\r\n 32\r\n0.0\r\n 13\r\n0.0\r\n 23\r\n1.0\r\n 33\r\n0.0\r\n";
const std::string dxf_end = "0\nENDSEC\n0\nEOF\n";

std::string dxf_message(const std::string& contents) {
    const auto read = parse_surfaces(contents, "a", Format::dxf);
    REQUIRE_FALSE(read);
    return read.error().message();
}

} // namespace

TEST_CASE("DXF: a surface for each layer", "[io][dxf]") {
    const auto read =
        parse_surfaces(dxf_entities + dxf_triangle + "0\nLINE\n8\nother\n10\n5\n20\n5\n30\n5\n" +
                           dxf_square + dxf_triangle + dxf_end,
                       "a", Format::dxf);
    REQUIRE(read);
    REQUIRE(read->size() == 2);
    CHECK(read->at(0).name == "top");
    CHECK(read->at(0).vertices == std::vector<Point3>{{0, 0, 1}, {2, 0, 1}, {0, 2, 1.5}});
    CHECK(read->at(0).triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}});
    CHECK(read->at(1).name == "fault 1");
    CHECK(read->at(1).triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("DXF: faces of blocks are passed over", "[io][dxf]") {
    const std::string blocks = "0\nSECTION\n2\nBLOCKS\n" + dxf_triangle + "0\nENDSEC\n";
    const auto read =
        parse_surfaces(blocks + dxf_entities + dxf_square + dxf_end, "a", Format::dxf);
    REQUIRE(read);
    CHECK(read->size() == 1);
    CHECK(dxf_message(blocks + dxf_entities + dxf_end) == "a: there is no 3DFACE");
}

TEST_CASE("DXF: what can't be read is named with its line", "[io][dxf]") {
    CHECK(dxf_message("AutoCAD Binary DXF\r\n\x1a") ==
          "a: binary DXF is not read; save it as ASCII");
    CHECK(dxf_message("x\n") == "a:1: \"x\" is no group code");
    CHECK(dxf_message("0") == "a:1: the file ends after a group code");
    CHECK(dxf_message(dxf_entities + dxf_triangle) ==
          "a:42: the file ends within the section ENTITIES");
    CHECK(dxf_message(dxf_entities + "0\n3DFACE\n10\nabc\n" + dxf_end) ==
          "a:18: \"abc\" is not a number");
    CHECK(dxf_message(dxf_entities + "0\n3DFACE\n10\n1\n20\n1\n" + dxf_end) ==
          "a:16: corner 2 of the 3DFACE has no x and y");
}
