// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Columns of points as programs write them: which are x, y and z is read from the file, or the file is refused.
#include "support/effort.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

namespace columns_test {

using namespace terrane;

namespace {

std::vector<Point3> points_of(const std::string& contents, Format format = Format::xyz) {
    const auto read = parse_surfaces(contents, "a", format, {});
    INFO(contents);
    if (!read) FAIL(read.error().message());
    REQUIRE(read->size() == 1);
    return read->at(0).vertices;
}

std::string message_of(const std::string& contents) {
    const auto read = parse_surfaces(contents, "a", Format::xyz, {});
    REQUIRE_FALSE(read);
    return read.error().message();
}

const std::vector<Point3> four{{0, 0, -1000}, {10, 0, -999.5}, {0, 10, -998}, {10, 10, -997.25}};

/// A way in which programs write points.
struct Style {
    std::string name;
    char separator;
    bool decimal_comma;
};

const std::vector<Style> styles{
    {"csv", ',', false},    {"excel", ';', true},   {"tabs", '\t', true},
    {"R", ',', false},      {"pandas", ',', false}, {"EarthVision", ' ', false},
    {"Petrel", ' ', false}, {"blanks", ' ', true},  {"comment", ' ', false}};

/// Draws points with further columns, and writes them.
class DirtyFile {
public:
    explicit DirtyFile(std::uint32_t seed) : random_(seed) {
        style_ = styles[random_() % styles.size()];
        for (std::size_t i = 0; i < 4 + random_() % 20; ++i)
            points.push_back({number(1000), number(1000), -500 - number(400)});
        const auto any = [&](const std::vector<std::string>& names) {
            return names[random_() % names.size()];
        };
        columns_ = {any({"X", "Easting", "x_coord", "EAST", "X (m)", "UTM_X"}),
                    any({"Y", "Northing", "y_coord", "NORTH", "Y (m)", "UTM_Y"}),
                    any({"Z", "Elevation", "RL", "elev", "Height", "TVDSS"})};
        if (style_.name == "EarthVision" || style_.separator == ' ')
            for (std::string& name : columns_) name = name.substr(0, name.find(' '));
        for (const char* more : {"ID", "Inline", "Crossline", "quality", "age_Ma"})
            if (random_() % 2 == 0) columns_.emplace_back(more);
        std::shuffle(columns_.begin(), columns_.end(), random_);
    }

    std::string text() {
        std::string out = heading();
        for (std::size_t row = 0; row < points.size(); ++row) {
            std::string line;
            if (style_.name == "R") line = fmt::format("\"{}\"", row + 1);
            if (style_.name == "pandas") line = fmt::format("{}", row);
            for (const std::string& name : columns_) {
                if (!line.empty()) line += style_.separator;
                line += cell(name, points[row]);
            }
            out += line + (style_.name == "excel" ? "\r\n" : "\n");
        }
        return out;
    }

    std::vector<Point3> points;

private:
    /// A multiple of 1/4, so that two decimals hold it.
    double number(double size) {
        return static_cast<double>(random_() % static_cast<unsigned>(4 * size)) / 4;
    }

    std::string cell(const std::string& name, const Point3& p) {
        const std::string lower = name.substr(0, 2);
        double value = static_cast<double>(random_() % 100);
        if (name[0] == 'X' || name[0] == 'x' || lower == "Ea" || lower == "EA" || name == "UTM_X")
            value = p.x;
        if (name[0] == 'Y' || name[0] == 'y' || lower == "No" || lower == "NO" || name == "UTM_Y")
            value = p.y;
        if (name == "Z" || name == "Elevation" || name == "RL" || name == "elev" ||
            name == "Height" || name == "TVDSS")
            value = p.z;
        std::string text = fmt::format("{:.2f}", value);
        if (style_.decimal_comma) std::ranges::replace(text, '.', ',');
        return text;
    }

    std::string heading() {
        std::string line;
        if (style_.name == "EarthVision") {
            line = "# Type: scattered data\n# Version: 6\n";
            for (std::size_t i = 0; i < columns_.size(); ++i)
                line +=
                    fmt::format("# Field: {} {}{}\n", i + 1, columns_[i], i == 2 ? " meters" : "");
            return line + "# End:\n";
        }
        if (style_.name == "Petrel") {
            line = "# Petrel Points with attributes\nVERSION 1\nBEGIN HEADER\n";
            for (const std::string& name : columns_)
                line += (name == "ID" || name == "Inline" ? "INT,"
                         : name == "quality"              ? "FLOAT,"
                                                          : "") +
                        name + "\n";
            return line + "END HEADER\n";
        }
        if (style_.name == "comment") line = "# ";
        if (style_.name == "R") line = "\"\"";
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (i > 0 || style_.name == "R" || style_.name == "pandas") line += style_.separator;
            line += style_.name == "R" ? '"' + columns_[i] + '"' : columns_[i];
        }
        return line + "\n";
    }

    std::mt19937 random_;
    Style style_;
    std::vector<std::string> columns_;
};

} // namespace

TEST_CASE("columns: headings of programs, in any order of columns") {
    const std::uint32_t draws = test_support::is_sanitized ? 300 : 3000;
    for (std::uint32_t seed = 0; seed < draws; ++seed) {
        DirtyFile file(seed);
        INFO("seed " << seed);
        REQUIRE(points_of(file.text()) == file.points);
    }
}

TEST_CASE("columns: a heading that does not say which are x, y and z is refused with its columns") {
    CHECK(message_of("ID,Rechts,Hoch,Teufe\n0,0,0,1\n1,10,0,2\n2,0,10,3\n") ==
          "a:2: the heading names the columns id, rechts, hoch, teufe, and not which of them are "
          "x, y and z: "
          "state them (--columns 3,4,5 or their names), or call them so, or easting, northing, "
          "elevation, depth");
    CHECK(message_of(
              "BEGIN HEADER\nINT,Inline\nlat\nlon\nTWT\nEND HEADER\n0 0 0 1\n1 10 0 2\n2 0 10 3\n")
              .find("the header names the columns Inline, lat, lon, TWT, and not which") !=
          std::string::npos);
    // Words that are no heading: another number of them than of columns, or no name of a coordinate.
    CHECK(points_of("Top of the reservoir\n0 0 1 7\n10 0 2 7\n0 10 3 7\n").size() == 3);
    CHECK(points_of("exported, by hand\n0,0,1\n10,0,2\n0,10,3\n").size() == 3);
}

TEST_CASE("columns: commas that may be decimal points or divide thousands are refused") {
    CHECK(message_of("1,000 2,000 3,000\n1,010 2,000 3,000\n1,000 2,010 3,000\n")
              .find("may be decimal points or divide thousands") != std::string::npos);
    CHECK(points_of("0,000;0,000;1,250\n10,000;0,000;1,250\n0,000;10,000;1,250\n") ==
          std::vector<Point3>{{0, 0, 1.25}, {10, 0, 1.25}, {0, 10, 1.25}});
    CHECK(points_of("0,0,1\n10,0,2\n0,10,3\n") ==
          std::vector<Point3>{{0, 0, 1}, {10, 0, 2}, {0, 10, 3}});
    CHECK(points_of("0, 0, 1\n10, 0, 2\n0, 10, 3\n") ==
          std::vector<Point3>{{0, 0, 1}, {10, 0, 2}, {0, 10, 3}});
}

TEST_CASE("columns: text in UTF-16 is read as it is in UTF-8") {
    const std::string text =
        "X;Y;Z;Größe\n0;0;-1000;1\n10;0;-999,5;1\n0;10;-998;1\n10;10;-997,25;1\n";
    std::string low = "\xFF\xFE", high = "\xFE\xFF";
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned code = static_cast<unsigned char>(text[i]);
        if (code >= 0xC0) code = (code & 31U) << 6U | (static_cast<unsigned char>(text[++i]) & 63U);
        low += {static_cast<char>(code & 0xFF), static_cast<char>(code >> 8U)};
        high += {static_cast<char>(code >> 8U), static_cast<char>(code & 0xFF)};
    }
    for (const std::string& contents : {text, low, high, "\xEF\xBB\xBF" + text})
        CHECK(points_of(contents) == four);
}

TEST_CASE("grids and GOCAD files under another extension are read as what they are") {
    const std::string zmap =
        "!comment\n@top, GRID, 2\n20, 1.0E+30, , 4, 1\n2, 2, 0.0, 10.0, 0.0, 10.0\n"
        "0.0, 0.0, 0.0\n@\n -998.0 -1000.0\n -997.25 -999.5\n";
    const std::string cps3 =
        "FSASCI 0 1 \"Computed\" 0 1e+30 0\nFSATTR 0 0\nFSLIMI 0 10 0 10 -1000 -997.25\n"
        "FSNROW 2 2\nFSXINC 10 10\n->MSMODL top\n-998 -1000\n-997.25 -999.5\n";
    const std::string esri =
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n"
        "-998 -997.25\n-1000 -999.5\n";
    const std::string irap =
        "-996 2 10 10\n0 10 0 10\n2 0 0 0\n0 0 0 0 0 0 0\n-1000 -999.5 -998 -997.25\n";
    const std::string gocad =
        "GOCAD TSurf 1\nHEADER {\nname: top\n}\nTFACE\nVRTX 1 0 0 -1000\nVRTX 2 10 0 -999.5\n"
        "VRTX 3 0 10 -998\nTRGL 1 2 3\nEND\n";
    const std::vector<std::pair<std::string, Format>> files{{zmap, Format::zmap},
                                                            {cps3, Format::cps3},
                                                            {esri, Format::esri},
                                                            {irap, Format::irap},
                                                            {gocad, Format::gocad}};
    for (const auto& [contents, format] : files)
        CHECK(points_of(contents) == points_of(contents, format));
}

TEST_CASE("columns: a caller states which they are, by number or by name") {
    const auto stated = [](const std::string& contents, const std::string& columns) {
        ReadOptions options;
        options.columns = columns;
        return parse_surfaces(contents, "a", Format::xyz, options);
    };
    const auto read_as = [&](const std::string& contents, const std::string& columns) {
        const auto read = stated(contents, columns);
        INFO(contents);
        if (!read) FAIL(read.error().message());
        REQUIRE(read->size() == 1);
        return read->at(0).vertices;
    };
    const std::string rows = "7,0,0,1,-1000\n7,10,0,2,-999.5\n7,0,10,3,-998\n7,10,10,4,-997.25\n";
    for (const std::string heading :
         {"", "A,B,C,D,E\n", "# any text, with commas\n", "x,y,z,no,rl\n"})
        CHECK(read_as(heading + rows, "2,3,5") == four);
    for (const std::string names : {"B,C,E", "b,c,e"})
        CHECK(read_as("A,B,C,D,E\n" + rows, names) == four);
    CHECK(read_as("A,\"Easting (m)\",C,x,Depth [m]\n" + rows, "Easting,C,Depth") == four);
    CHECK(read_as("z,x,y,no,base\n" + rows, "x,y,base") == four); // not the column called z
    CHECK(read_as("# Field: 1 q meters\n# Field: 2 a\n# Field: 3 b\n# Field: 4 c\n# Field: 5 d\n"
                  "7 0 0 1 -1000\n7 10 0 2 -999.5\n7 0 10 3 -998\n7 10 10 4 -997.25\n",
                  "a,b,d") == four);
    // Cells may be empty, and commas may be decimal points.
    CHECK(read_as("a;b;;d\n;0;0;-1000\n1;10;0;-999,5\n;0;10;-998\n;10;10;-997,25\n", "2,3,4") ==
          four);
    const auto missing = stated("A,B,C,D,E\n" + rows, "B,C,depth");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().message().find("B, C, depth") != std::string::npos);
    CHECK_FALSE(stated(rows, "B,C,E"));  // there is no heading
    CHECK_FALSE(stated(rows, "2,3,9"));  // no such column
    CHECK_FALSE(stated(rows, "2,3,65")); // nor so many
    CHECK_FALSE(stated(rows, "0,1,2"));
}

TEST_CASE("columns: what is stated is three columns of a file that has some") {
    const auto check = [](Format format, const std::string& columns) {
        ReadOptions options;
        options.columns = columns;
        return check_reading({format}, options, {"d", "m", "c"});
    };
    CHECK(check(Format::xyz, "1,2,3"));
    for (const std::string wrong : {"1,2", "1,2,3,4", ",,", "1,,3", "1,2,", ",2,3"}) {
        const auto refused = check(Format::xyz, wrong);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().place == "c");
    }
    CHECK_FALSE(check(Format::gocad, "1,2,3"));
    CHECK_FALSE(check(Format::vset, "1,2,3"));
}

} // namespace columns_test
