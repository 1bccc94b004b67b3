// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <fmt/format.h>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/grids/cps3.hpp>
#include <terrane/io/grids/esri.hpp>
#include <terrane/io/grids/irap.hpp>
#include <terrane/io/grids/surfer.hpp>
#include <terrane/io/grids/zmap.hpp>
#include <terrane/io/text/bytes.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Makes a grid of values that are exact in float32, some of them missing.
Grid sample(std::uint32_t nx, std::uint32_t ny, unsigned seed) {
    std::mt19937 random(seed);
    Grid grid{"top", 461000.5, 5932000.25, nx, ny, 25.5, 12.5, 0, {}};
    for (std::uint32_t k = 0; k < nx * ny; ++k)
        grid.values.push_back(random() % 5 == 0 ? none : double(int(random() % 20000)) / 8 - 500);
    return grid;
}

std::string number(double value, const char* null) {
    return std::isnan(value) ? null : fmt::format("{}", value);
}

std::string irap_text(const Grid& g) {
    auto text = fmt::format("-996 {} {} {}\n0 1 0 1\n{} {} {} {}\n0 0 0 0 0 0 0\n", g.ny, g.dx,
                            g.dy, g.nx, g.rotation, g.x, g.y);
    for (std::size_t k = 0; k < g.values.size(); ++k)
        text += number(g.values[k], "9999900.000000") + (k % 4 == 3 ? "\n" : " ");
    return text;
}

template <class T>
void put(std::string& out, T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::little)
        std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
}

std::string record(const std::string& payload) {
    std::string out;
    put(out, std::uint32_t(payload.size()));
    out += payload;
    put(out, std::uint32_t(payload.size()));
    return out;
}

std::string irap_binary(const Grid& g) {
    std::string first, second, third(28, '\0'), out;
    put(first, std::int32_t{-996});
    put(first, std::int32_t(g.ny));
    for (const double v : {0.0, 1.0, 0.0, 1.0, g.dx, g.dy}) put(first, float(v));
    put(second, std::int32_t(g.nx));
    for (const double v : {g.rotation, g.x, g.y}) put(second, float(v));
    out = record(first) + record(second) + record(third);
    for (std::uint32_t j = 0; j < g.ny; ++j) {
        std::string row;
        for (std::uint32_t i = 0; i < g.nx; ++i) {
            const double v = g.values[j * g.nx + i];
            put(row, std::isnan(v) ? 1e30F : float(v));
        }
        out += record(row);
    }
    return out;
}

/// Writes the columns from the left, each from the top down.
std::string columns(const Grid& g, const char* null, int width = 0) {
    std::string text;
    for (std::uint32_t i = 0; i < g.nx; ++i) {
        for (std::uint32_t j = g.ny; j-- > 0;)
            text += fmt::format("{:>{}} ", number(g.values[j * g.nx + i], null), width);
        text += "\n";
    }
    return text;
}

std::string zmap_text(const Grid& g) {
    return fmt::format("! comment\n@top HEADER      , GRID, 5\n 15, -99999.0000, , 4, 1\n"
                       "{}, {}, {}, {}, {}, {},\n0.0, 0.0, 0.0\n@\n+ data\n{}",
                       g.ny, g.nx, g.x, g.x + (g.nx - 1) * g.dx, g.y, g.y + (g.ny - 1) * g.dy,
                       columns(g, "-99999.0000"));
}

std::string cps3_text(const Grid& g) {
    return fmt::format("FSASCI 0 1 COMPUTED 0 0.1E+31\nFSATTR 0 0\nFSLIMI {} {} {} {} 0 1\n"
                       "FSNROW {} {}\nFSXINC {} {}\n->top\n{}",
                       g.x, g.x + (g.nx - 1) * g.dx, g.y, g.y + (g.ny - 1) * g.dy, g.ny, g.nx, g.dx,
                       g.dy, columns(g, "0.1E+31"));
}

std::string esri_text(const Grid& g, bool corner) {
    auto text =
        fmt::format("ncols {}\nNROWS {}\n{} {}\n{} {}\ndx {}\ndy {}\nNODATA_value -1e10\n", g.nx,
                    g.ny, corner ? "xllcorner" : "xllcenter", corner ? g.x - g.dx / 2 : g.x,
                    corner ? "yllcorner" : "YLLCENTER", corner ? g.y - g.dy / 2 : g.y, g.dx, g.dy);
    for (std::uint32_t j = g.ny; j-- > 0;) {
        for (std::uint32_t i = 0; i < g.nx; ++i)
            text += number(g.values[j * g.nx + i], "-1e10") + " ";
        text += "\n";
    }
    return text;
}

/// A grid of Surfer, in text or in a binary version; the heights are floats.
std::string surfer_file(const Grid& g, int version) {
    const double last_x = g.x + (g.nx - 1) * g.dx, last_y = g.y + (g.ny - 1) * g.dy;
    if (version == 0) {
        std::string text =
            fmt::format("DSAA\n{} {}\n{} {}\n{} {}\n0 1\n", g.nx, g.ny, g.x, last_x, g.y, last_y);
        for (std::size_t k = 0; k < g.values.size(); ++k)
            text += number(g.values[k], "1.70141e+038") + ((k + 1) % g.nx == 0 ? "\n" : " ");
        return text;
    }
    std::string bytes = version == 6 ? "DSBB" : "DSRB";
    const auto all = [&](std::initializer_list<double> numbers) {
        for (const double n : numbers) terrane::detail::store(bytes, n);
    };
    if (version == 6) {
        terrane::detail::store(bytes, static_cast<std::uint16_t>(g.nx));
        terrane::detail::store(bytes, static_cast<std::uint16_t>(g.ny));
        all({g.x, last_x, g.y, last_y, 0, 1});
        for (const double v : g.values)
            terrane::detail::store(bytes, std::isnan(v) ? 1.70141e38F : static_cast<float>(v));
        return bytes;
    }
    const auto whole = [&](std::uint32_t n) { terrane::detail::store(bytes, n); };
    whole(4);
    whole(1); // the version
    bytes += "NOTE";
    whole(3);
    bytes += "abcGRID";
    whole(72);
    whole(g.ny);
    whole(g.nx);
    all({g.x, g.y, g.dx, g.dy, 0, 1, 0, -1e10});
    bytes += "DATA";
    whole(static_cast<std::uint32_t>(8 * g.values.size()));
    for (const double v : g.values) all({std::isnan(v) ? -1e10 : v});
    return bytes;
}

void check_same(const Result<Grid>& read, const Grid& g, double rounding = 0) {
    REQUIRE(message_of(read) == "no error");
    const Grid& r = read.value();
    CHECK(r.name == g.name);
    CHECK(r.nx == g.nx);
    CHECK(r.ny == g.ny);
    CHECK(r.x == Approx(g.x).margin(rounding));
    CHECK(r.y == Approx(g.y).margin(rounding));
    CHECK(r.dx == Approx(g.dx));
    CHECK(r.dy == Approx(g.dy));
    CHECK(r.rotation == g.rotation);
    REQUIRE(r.values.size() == g.values.size());
    for (std::size_t k = 0; k < g.values.size(); ++k)
        CHECK((std::isnan(g.values[k]) ? std::isnan(r.values[k]) : r.values[k] == g.values[k]));
}

} // namespace

TEST_CASE("grids: a part of a Surfer grid is an error, wherever it ends", "[io][grid]") {
    const Grid g = sample(3, 2, 1);
    for (const int version : {0, 6, 7}) {
        const std::string whole = surfer_file(g, version);
        const std::size_t end =
            whole.size() - (version == 0 ? 3 : 1); // behind the last height's first digit
        for (std::size_t size = 4; size < end; ++size)
            CHECK_FALSE(read_surfer(std::string_view(whole).substr(0, size), "a", "top"));
    }
}

TEST_CASE("grids: each format gives back what was written in it", "[io][grid]") {
    for (unsigned seed = 0; seed < 5; ++seed) {
        Grid g = sample(3 + seed, 9 - seed, seed);
        check_same(read_zmap(zmap_text(g), "a", "a"), g);
        check_same(read_cps3(cps3_text(g), "a", "a"), g);
        check_same(read_esri(esri_text(g, false), "a", "top"), g);
        check_same(read_esri(esri_text(g, true), "a", "top"), g);
        for (const int version : {0, 6, 7})
            check_same(read_surfer(surfer_file(g, version), "a", "top"), g);
        g.rotation = 30;
        check_same(read_irap(irap_text(g), "a", "top"), g);
        check_same(read_irap(irap_binary(g), "a", "top"), g, 0.25);
    }
}

TEST_CASE("ZMAP+: fields that touch, and a text for no height", "[io][grid]") {
    const auto read = read_zmap("@top HEADER, GRID, 3\n4, -999, NUL, 0, 1\n3,2,0,1,0,2\n0,0,0\n@\n"
                                "100020003000\n4000-999 NUL\n",
                                "a", "a");
    Grid g{"top", 0, 0, 2, 3, 1, 1, 0, {3000, none, 2000, none, 1000, 4000}};
    check_same(read, g);
}

TEST_CASE("grids: cells with three or four heights become triangles, and no others", "[io][grid]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Grid g = sample(6, 5, seed);
        g.rotation = 15.0 * seed;
        if (seed % 3 == 1) g.dy = -g.dy;
        std::size_t triangles = 0, nodes = 0;
        double area = 0;
        for (std::uint32_t j = 0; j + 1 < g.ny; ++j)
            for (std::uint32_t i = 0; i + 1 < g.nx; ++i) {
                int have = 0;
                for (const auto k :
                     {j * g.nx + i, j * g.nx + i + 1, (j + 1) * g.nx + i, (j + 1) * g.nx + i + 1})
                    have += std::isnan(g.values[k]) ? 0 : 1;
                triangles += have == 4 ? 2 : have == 3 ? 1 : 0;
                area += have == 4 ? 1 : have == 3 ? 0.5 : 0;
            }
        for (const double v : g.values) nodes += std::isnan(v) ? 0 : 1;
        const auto made = surface_of_grid(g);
        REQUIRE(made);
        const Surface& s = made.value();
        CHECK(s.vertices.size() == nodes);
        CHECK(s.triangles.size() == triangles);
        double sum = 0; // front up: each is positive
        for (const Triangle& t : s.triangles) {
            const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
            const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            CHECK(twice > 0);
            sum += twice / 2;
        }
        CHECK(sum == Approx(area * g.dx * std::abs(g.dy)).epsilon(1e-6));
        const auto report = check(std::span(&s, 1));
        REQUIRE(report);
        CHECK(report.value().clean());
    }
}

TEST_CASE("grids: the diagonal joins the ends that differ less in height", "[io][grid]") {
    const auto has_edge = [](std::vector<double> values, std::uint32_t a, std::uint32_t b) {
        const auto s = surface_of_grid({"g", 0, 0, 2, 2, 1, 1, 0, std::move(values)});
        REQUIRE(s);
        int found = 0;
        for (const Triangle& t : s.value().triangles)
            for (unsigned i = 0; i < 3; ++i)
                found += (t[i] == a && t[(i + 1) % 3] == b) || (t[i] == b && t[(i + 1) % 3] == a);
        return found == 2;
    };
    CHECK(has_edge({0, 5, 5, 1}, 1, 2));
    CHECK(has_edge({0, 5, 9, 1}, 0, 3));
    CHECK(has_edge({7, 7, 7, 7}, 0, 3));
}

TEST_CASE("grids: turned by quarters they are exact; depths become elevations", "[io][grid]") {
    Grid g{"g", 10, 20, 2, 2, 3, 4, 90, {1, 2, 0, 4}};
    const auto s = surface_of_grid(g, true);
    REQUIRE(s);
    CHECK(s.value().vertices ==
          std::vector<Point3>{{10, 20, -1}, {10, 23, -2}, {6, 20, 0}, {6, 23, -4}});
    CHECK_FALSE(std::signbit(s.value().vertices[2].z));
    g.rotation = -270;
    CHECK(surface_of_grid(g, true).value().vertices == s.value().vertices);
    CHECK(height_at(g, 8, 21.5) == Approx((1 + 2 + 0 + 4) / 4.0));
    CHECK(std::isnan(height_at(g, 80, 21.5)));
}

TEST_CASE("grids: what can't be a surface is said", "[io][grid]") {
    using enum ErrorCode;
    CHECK(surface_of_grid({"g", 0, 0, 2, 2, 1, 1, 0, {1, none, none, 1}}).error().code ==
          nothing_to_do);
    CHECK(surface_of_grid({"g", 0, 0, 2, 2, 1, 1, 0, {1}}).error().code == bad_option);
    CHECK(surface_of_grid({"g", 1e308, 0, 3, 2, 1e308, 1, 0, {1, 1, 1, 1, 1, 1}}).error().code ==
          bad_number);
    const auto message = [](std::string_view text, Format format) {
        return message_of(parse_surfaces(text, "a", format));
    };
    CHECK(message("", Format::irap) == "a: the file ends before -996");
    CHECK(message("-995 1", Format::irap) == "a:1: an Irap grid begins with -996");
    CHECK(message("-996 90000 1 1\n0 1 0 1\n90000 0 0 0\n0 0 0 0 0 0 0\n1 2 3\n", Format::irap) ==
          "a:4: the file is too short for 90000 x 90000 heights");
    CHECK(message("-996 2 0 1\n0 1 0 1\n2 0 0 0\n0 0 0 0 0 0 0\n1 2 3 4\n", Format::irap) ==
          "a:4: the nodes of the grid coincide");
    CHECK(message("-996 2 1 1\n0 1 0 1\n2 0 0 0\n0 0 0 0 0 0 0\n1 2 3 4 5\n", Format::irap) ==
          "a:5: there are more than 2 x 2 heights");
    CHECK(message("-996 2 1 1\n0 1 0 1\n2 0 0 0\n0 0 0 0 0 0 0\n1 2 x 4\n", Format::irap) ==
          "a:5: \"x\" is not a number");
    CHECK(message("-996 2 1 1\n0 1 0 1\n2 0 0 0\n0 0 0 0 0 0 0\n1 2 3\n", Format::irap) ==
          "a:5: the file ends before the last height");
    CHECK(message("@a, LINE, 1\n", Format::zmap) == "a:1: \"LINE\" is not read, only GRID");
    CHECK(message("hello\n", Format::zmap) == "a:1: expected a line that begins with @");
    CHECK(message("FSNROW 2 2\n1 2 3 4\n", Format::cps3) ==
          "a:2: a CPS-3 grid needs FSLIMI and FSNROW before its heights");
    CHECK(message("ncols 2\nnrows 2\ncellsize 1\nyllcorner 0\n1 2\n3 4\n", Format::esri) ==
          "a:5: xllcorner or xllcenter is missing");
    CHECK(message("ncols 2.5\nnrows 2\ncellsize 1\n1 2\n3 4\n", Format::esri) ==
          "a:4: ncols is missing or no number of cells");
    CHECK(message("ncols 2\nnrows 2\n", Format::esri) == "a:2: the file ends before the heights");
    std::string binary = irap_binary(sample(4, 3, 1));
    CHECK(message(binary.substr(0, 90), Format::irap) ==
          "a, byte 64: a record of 28 bytes is missing");
    binary[4] = 0;
    CHECK(message(binary, Format::irap) == "a, byte 40: an Irap grid begins with -996");
}
