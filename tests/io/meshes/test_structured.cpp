// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading structured grids of VTK, .vts and legacy: files that VTK wrote (tests/data/other_programs), and broken ones.
#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>

#include "support/paths.hpp"

using namespace terrane;
using namespace test_support;

namespace {

using Corners = std::vector<std::array<Point3, 3>>;

std::string of_vtk(const std::string& name) {
    return test_data() + "/other_programs/vtk_" + name;
}

Corners corners_of(const Surface& s) {
    Corners all;
    for (const Triangle& t : s.triangles)
        all.push_back({s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]});
    return all;
}

} // namespace

TEST_CASE("VTS and legacy VTK: structured grids with one point along an axis", "[io][vtk]") {
    const Point3 a{0, 0, 0}, b{2, 0, 0}, c{2, 1, 0.5}, d{0, 1, 0.5}, e{0, 2, 0.1}, f{2, 2, 0.1};
    const Corners first{{a, b, c}, {a, c, d}};
    auto both = first;
    both.insert(both.end(), {{d, c, f}, {d, f, e}});
    for (const std::string name : {"structured_ascii.vtk", "structured_binary.vtk", "lzma.vts"}) {
        const auto read = read_surfaces(of_vtk(name));
        INFO(name);
        if (!read) FAIL(read.error().message());
        REQUIRE(read->size() == 1);
        CHECK(corners_of(read->front()) == both);
    }
    const auto blank = read_surfaces(of_vtk("blank.vts"));
    REQUIRE(blank);
    CHECK(corners_of(blank->front()) == first);
}

TEST_CASE("legacy VTK: a structured grid must fit its points, and be a surface", "[io][vtk]") {
    const std::string start = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n";
    const std::string points = "POINTS 4 float\n0 0 0 1 0 0\n0 1 0 1 1 0\n";
    const auto with = [&](const std::string& dimensions) {
        return parse_surfaces(start + dimensions + points, "a", Format::vtk);
    };
    REQUIRE(with("DIMENSIONS 2 2 1\n"));
    CHECK(with("DIMENSIONS 1 2 2\n")->front().triangles.size() == 2);
    for (const auto* bad : {"", "DIMENSIONS 3 2 1\n", "DIMENSIONS 2 1 1\n", "DIMENSIONS 0 0 1\n"})
        CHECK(with(bad).error().code == ErrorCode::bad_syntax);
    CHECK(with("DIMENSIONS 4 1 1\n").error().code == ErrorCode::nothing_to_do);
    CHECK(with("DIMENSIONS 2 2 2\n").error().code == ErrorCode::unsupported);
}

TEST_CASE("VTS: an extent that does not fit is refused", "[io][vtk]") {
    const std::string good = read_file(of_vtk("lzma.vts")).value();
    const std::string piece = "<Piece Extent=\"0 1 0 0 0 2\"";
    REQUIRE(good.find(piece) != std::string::npos);
    for (const auto* bad :
         {"0 2 0 0 0 2", "0 1 0 0 0", "1 0 0 0 0 2", "-2147483648 2147483647 0 0 0 2"}) {
        std::string text = good;
        text.replace(text.find(piece), piece.size(), "<Piece Extent=\"" + std::string(bad) + "\"");
        const auto read = parse_surfaces(text, "a", Format::vts);
        REQUIRE_FALSE(read);
        CHECK(read.error().code == ErrorCode::bad_syntax);
    }
}
