// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Outlines in shapefiles that shapelib wrote, in one of another program, and in broken ones. A build
// without shapelib says so.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/points/outline.hpp>
#include <terrane/io/points/shape_outline.hpp>

#include "support/files.hpp"
#include "support/paths.hpp"

#ifdef TERRANE_HAS_SHAPELIB
#include <shapefil.h>
#endif

using namespace terrane;
using namespace test_support;

#ifdef TERRANE_HAS_SHAPELIB

namespace {

using CornerList = std::vector<std::array<double, 2>>;

const CornerList shape_ring{{0, 0}, {0, 3.5}, {4.1, 3.5}, {4.1, 0}, {0, 0}};

/// A polygon of one or several rings; `type` is one of shapelib's.
struct TestShape {
    int type = SHPT_POLYGON;
    std::vector<CornerList> rings{shape_ring};
};

/// Returns the contents of the .shp that shapelib writes.
std::string shapefile(const std::vector<TestShape>& shapes, int type = SHPT_POLYGON) {
    const TemporaryFolder folder;
    const auto path = (folder / "a.shp").string();
    SHPHandle file = SHPCreate(path.c_str(), type);
    REQUIRE(file != nullptr);
    for (const TestShape& shape : shapes) {
        std::vector<int> starts;
        std::vector<double> x, y, z;
        for (const CornerList& ring : shape.rings) {
            starts.push_back(static_cast<int>(x.size()));
            for (const auto& corner : ring) {
                x.push_back(corner[0]);
                y.push_back(corner[1]);
                z.push_back(-1000);
            }
        }
        SHPObject* object =
            SHPCreateObject(shape.type, -1, static_cast<int>(starts.size()), starts.data(), nullptr,
                            static_cast<int>(x.size()), x.data(), y.data(), z.data(), nullptr);
        SHPWriteObject(file, -1, object);
        SHPDestroyObject(object);
    }
    SHPClose(file);
    return read_file(path).value();
}

void check_shape_refused(const std::string& contents, ErrorCode code, const std::string& message) {
    const auto read = read_outline(contents, "a.shp");
    REQUIRE_FALSE(read);
    CHECK(read.error().code == code);
    CHECK(read.error().message() == message);
}

} // namespace

TEST_CASE("shapefile: the ring of its polygon, with or without heights", "[io][outline]") {
    REQUIRE(reads_shapefiles());
    for (const int type : {SHPT_POLYGON, SHPT_POLYGONZ, SHPT_POLYGONM}) {
        const auto read = read_outline(shapefile({{type}}, type), "a.SHP");
        INFO(type << (read ? "" : read.error().message()));
        REQUIRE(read);
        CHECK(*read == shape_ring);
    }
    // Shapes without a corner are passed over.
    const auto padded = read_outline(shapefile({{SHPT_NULL, {}}, {}, {SHPT_NULL, {}}}), "a.shp");
    REQUIRE(padded);
    CHECK(*padded == shape_ring);
}

TEST_CASE("shapefile: what is no outline is named", "[io][outline]") {
    using enum ErrorCode;
    const CornerList hole{{1, 1}, {2, 1}, {2, 2}, {1, 1}};
    check_shape_refused(shapefile({{SHPT_POLYGON, {shape_ring, hole}}}), unsupported,
                        "a.shp: polygon 1 has 2 rings, holes or parts; an outline is one ring");
    check_shape_refused(shapefile({{}, {}}), unsupported,
                        "a.shp: polygon 2 is a second one; an outline is one, so keep one in the "
                        "file");
    check_shape_refused(shapefile({}), nothing_to_do, "a.shp: there is no polygon");
    check_shape_refused(shapefile({{SHPT_POINT, {{{1, 2}}}}}, SHPT_POINT), unsupported,
                        "a.shp: the file has points; an outline is a polygon");
    const auto lines = read_file(test_data() + "/loopstructural/fault_trace.shp");
    REQUIRE(lines);
    check_shape_refused(*lines, unsupported, "a.shp: the file has lines; an outline is a polygon");
}

TEST_CASE("shapefile: broken files", "[io][outline]") {
    using enum ErrorCode;
    const std::string good = shapefile({{}});
    check_shape_refused("", bad_syntax,
                        "a.shp: this is no shapefile: it does not begin with its code");
    check_shape_refused(std::string(200, 'x'), bad_syntax,
                        "a.shp: this is no shapefile: it does not begin with its code");
    check_shape_refused(good.substr(0, good.size() - 1), bad_syntax,
                        "a.shp: the file ends within record 1");
    check_shape_refused(good + "1234", bad_syntax, "a.shp: the file ends within record 2");
    std::string many = good; // more corners than the record has
    many[100 + 8 + 4 + 32 + 4] = 99;
    check_shape_refused(many, bad_syntax, "a.shp: record 1 is broken");
    std::string infinite = good;
    infinite.replace(infinite.size() - 8, 8, std::string("\0\0\0\0\0\0\xf0\x7f", 8));
    check_shape_refused(infinite, bad_number, "a.shp: corner 5 of polygon 1 is not finite");
    for (std::size_t length = 0; length < good.size(); ++length) // no length is a crash
        (void)read_outline(std::string_view(good).substr(0, length), "a.shp");
}

#else

TEST_CASE("shapefile: a build without shapelib says so", "[io][outline]") {
    CHECK_FALSE(reads_shapefiles());
    const auto read = read_outline("", "a.shp");
    REQUIRE_FALSE(read);
    CHECK(
        read.error().message() ==
        "a.shp: this build cannot read shapefiles, as shapelib (libshp-dev) was not there when it "
        "was made");
}

#endif
