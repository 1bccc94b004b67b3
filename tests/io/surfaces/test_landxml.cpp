// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include <terrane/io/files.hpp>

namespace landxml_test {

using namespace terrane;

namespace {

const std::string start = R"(<?xml version="1.0"?>
<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2">
<Units><Imperial linearUnit="USSurveyFoot" areaUnit="squareFoot"/></Units>
<CoordinateSystem desc="Nevada East" epsgCode="32107"/>
<Surfaces>
)";
const std::string points = R"(<Pnts><P id="7">4200000.5 500000.25 12.5</P><P id="3">
4200010 500000 13</P><P id="9">4200010 500010 14</P><P id="4">4200000 500010 15</P></Pnts>
)";

std::string with(const std::string& definition, const std::string& name = "EG") {
    return start + "<Surface name=\"" + name + "\"><Definition surfType=\"TIN\">\n" + definition +
           "</Definition></Surface></Surfaces></LandXML>";
}

auto read(const std::string& text) {
    return parse_surfaces(text, "a.xml", Format::landxml);
}

} // namespace

TEST_CASE("LandXML: northing first, ids in any order, units and system", "[io][landxml]") {
    const auto surfaces =
        read(with(points + "<Faces><F n=\"0 1\">7 9 3</F><F i=\"1\">7 4 9</F></Faces>"));
    if (!surfaces) FAIL(surfaces.error().message());
    REQUIRE(surfaces->size() == 1);
    const Surface& s = surfaces->front();
    CHECK(s.name == "EG");
    CHECK(s.vertices == std::vector<Point3>{{500000.25, 4200000.5, 12.5},
                                            {500000, 4200010, 13},
                                            {500010, 4200010, 14}});
    CHECK(s.triangles == std::vector<Triangle>{{0, 2, 1}}); // the other face is invisible
    CHECK(s.frame.horizontal_unit == "ftUS");
    CHECK(s.frame.vertical_unit == "ftUS");
    CHECK(s.frame.system == "Nevada East");
}

TEST_CASE("LandXML: faces of four corners, and surfaces without faces or name", "[io][landxml]") {
    const auto quad = read(with(points + "<Faces><F>7 4 9 3</F></Faces>", ""));
    REQUIRE(quad);
    CHECK(quad->front().triangles.size() == 2);
    CHECK(quad->front().name == "a");
    const auto none = read(with(points));
    CHECK(none.error().code == ErrorCode::nothing_to_do);
    CHECK(read("<LandXML/>").error().code == ErrorCode::nothing_to_do);
}

TEST_CASE("LandXML: what can't be read is named with its line", "[io][landxml]") {
    const auto said = [](const std::string& text) { return read(text).error().message(); };
    CHECK(said("<a/>") == "a.xml:1: there is no element LandXML");
    CHECK(said(with(points + "<Faces><F>7 8 3</F></Faces>")) ==
          "a.xml:9: the face names point \"8\", which does not exist");
    CHECK(said(with(points + "<Faces><F>7 3</F></Faces>")) == "a.xml:9: a face needs 3 corners");
    CHECK(said(with("<Pnts><P id=\"1\">1 2</P></Pnts>")) ==
          "a.xml:7: a point needs northing, easting and elevation, not \"\"");
    CHECK_FALSE(read(with("<Pnts><P id=\"1\">1 2 nan</P></Pnts>")));
    CHECK(said(with("<Pnts><P id=\"1\">1 2 3</P><P id=\"1\">1 2 4</P></Pnts>")) ==
          "a.xml:7: there are two points \"1\"");
    const std::string whole = with(points + "<Faces><F>7 9 3</F></Faces>");
    for (std::size_t n = 0; n < whole.size(); ++n) CHECK_FALSE(read(whole.substr(0, n)));
}

} // namespace landxml_test
