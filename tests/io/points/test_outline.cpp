// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include <terrane/io/points/outline.hpp>

using namespace terrane;

namespace {

using Ring = std::vector<std::array<double, 2>>;

const Ring outline_ring{{0, 0}, {4, 0}, {4, 3.5}, {0, 0}};
const std::string outline_coordinates = "[[0, 0], [4, 0, -12], [4, 3.5], [0, 0]]";
const std::string outline_polygon =
    R"({"type": "Polygon", "coordinates": [)" + outline_coordinates + "]}";

void check_outline_refused(const std::string& contents, ErrorCode code,
                           const std::string& message) {
    const auto read = read_outline(contents, "a.geojson");
    INFO(contents);
    REQUIRE_FALSE(read);
    CHECK(read.error().code == code);
    CHECK(read.error().message() == message);
}

} // namespace

TEST_CASE("outline: columns of numbers", "[io][outline]") {
    const auto read = read_outline("# licence\n0 0\n4,0 # east\n\n4\t3.5 17\n0 0\n", "a.txt");
    REQUIRE(read);
    CHECK(*read == outline_ring);
    // RMS ends each polygon so, and repeats the first corner.
    const auto ended = read_outline("0 0 -9\n4 0 -9\n4 3.5 -9\n0 0 -9\n999.0 999 999\n", "a.pol");
    REQUIRE(ended);
    CHECK(*ended == outline_ring);
    CHECK(read_outline("999 999\n0 0\n1 1\n", "a").value().size() == 3); // two numbers are a corner
    CHECK(read_outline("0 0 0\n999 999 999\n4 4 0\n", "a").error().message() ==
          "a:3: a second polygon begins here; an outline is one, so keep one in the file");
    CHECK(read_outline("0 0\n4\n", "a").error().message() == "a:2: a corner needs two numbers");
    CHECK(read_outline("# nothing\n", "a").error().message() == "a: there is no corner");
}

TEST_CASE("outline: GeoJSON", "[io][outline]") {
    const std::string feature =
        R"({"type": "Feature", "properties": {"type": 7}, "geometry": )" + outline_polygon + "}";
    const std::string point = R"({"type": "Point", "coordinates": [1, 2]})";
    for (const std::string& text :
         {outline_polygon, feature,
          R"({"type": "MultiPolygon", "coordinates": [[)" + outline_coordinates + "]]}",
          R"({"type": "FeatureCollection", "name": "licence", "features": [)" + feature + "]}",
          R"({"type": "GeometryCollection", "geometries": [)" + point + "," + outline_polygon +
              "]}"}) {
        const auto read = read_outline(text, "a.GeoJSON");
        INFO(text);
        REQUIRE(read);
        CHECK(*read == outline_ring);
    }
}

TEST_CASE("outline: GeoJSON that is no outline", "[io][outline]") {
    using enum ErrorCode;
    check_outline_refused("{\n\"type\": \n}", bad_syntax,
                          "a.geojson:3: this is not well-formed JSON");
    check_outline_refused("[1e999]", bad_number, "a.geojson: a number is too large");
    check_outline_refused("[]", bad_syntax, "a.geojson: this is no object of GeoJSON");
    check_outline_refused("{}", bad_syntax, "a.geojson: it has no type");
    check_outline_refused(R"({"type": "Circle"})", bad_syntax,
                          "a.geojson: \"Circle\" is no type of GeoJSON");
    check_outline_refused(R"({"type": "Point", "coordinates": [1, 2]})", nothing_to_do,
                          "a.geojson: there is no polygon");
    check_outline_refused(R"({"type": "Polygon"})", bad_syntax,
                          "a.geojson: coordinates: an array is needed");
    check_outline_refused(R"({"type": "Polygon", "coordinates": [)" + outline_coordinates + "," +
                              outline_coordinates + "]}",
                          unsupported,
                          "a.geojson: coordinates: the polygon has a hole; an outline is one ring");
    check_outline_refused(
        R"({"type": "GeometryCollection", "geometries": [)" + outline_polygon + "," +
            outline_polygon + "]}",
        unsupported,
        "a.geojson: geometries[1].coordinates: this is a second polygon; an outline is one, so "
        "keep one in the file");
    check_outline_refused(R"({"type": "Polygon", "coordinates": [[[0, 0], [1]]]})", bad_number,
                          "a.geojson: coordinates[0][1]: a corner needs two numbers");
}
