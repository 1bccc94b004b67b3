// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cstring>
#include <sstream>

#include <pugixml.hpp>

#include <terrane/io/meshes/vtk.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

std::string decoded(std::string_view base64) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : base64) {
        const auto digit = digits.find(c);
        if (digit == std::string_view::npos) continue;
        bits = bits << 6 | static_cast<unsigned>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 255);
    }
    return bytes;
}

/// Reads an uncompressed array: the number of its bytes, then the bytes.
template <class T>
std::vector<T> values(const pugi::xml_node& parent, const char* name) {
    const auto node = parent.find_child_by_attribute("DataArray", "Name", name);
    REQUIRE(node);
    const auto bytes = decoded(node.text().get());
    std::uint64_t size = 0;
    REQUIRE(bytes.size() >= sizeof size);
    std::memcpy(&size, bytes.data(), sizeof size);
    REQUIRE(bytes.size() == sizeof size + size);
    std::vector<T> result(size / sizeof(T));
    if (size != 0) std::memcpy(result.data(), bytes.data() + sizeof size, size);
    return result;
}

std::vector<std::string> strings(const pugi::xml_node& field, const char* name,
                                 const char* element = "Array") {
    std::istringstream codes(field.find_child_by_attribute(element, "Name", name).text().get());
    std::vector<std::string> result(1);
    for (int code = 0; codes >> code;)
        if (code == 0)
            result.emplace_back();
        else
            result.back() += static_cast<char>(code);
    result.pop_back();
    return result;
}

using Ints = std::vector<std::int32_t>;
using Longs = std::vector<std::int64_t>;

} // namespace

TEST_CASE("VTP: what is in it", "[io][vtk]") {
    const auto mesh = awkward_mesh();
    const CellArray volume{"volume <1>", Ints{4, 3, 2, 1}};
    const CellArray quality{"quality", std::vector<double>{0.5, 0.25, 1, 0}};
    const std::vector<CellArray> further{volume, quality};
    const auto text = to_vtp(mesh, false, further);
    REQUIRE(text);
    pugi::xml_document xml;
    REQUIRE(xml.load_string(text.value().c_str()));
    const auto data = xml.child("VTKFile").child("PolyData");
    const auto field = data.child("FieldData");
    CHECK(strings(field, "surface_name") ==
          std::vector<std::string>{"top reservoir", "main \"A\" fault", "top reservoir"});
    CHECK(strings(field, "surface_role") ==
          std::vector<std::string>{"horizon", "fault", "unknown"});
    CHECK(values<std::int64_t>(field, "surfaces_offset") == Longs{0, 1, 3, 4, 5});
    CHECK(values<std::int64_t>(field, "surfaces") == Longs{0, 0, 1, 1, 2});
    const auto piece = data.child("Piece");
    CHECK(piece.attribute("NumberOfPoints").as_int() == 6);
    CHECK(piece.attribute("NumberOfPolys").as_int() == 4);
    const auto cells = piece.child("CellData");
    CHECK(values<std::int32_t>(cells, "surface") == Ints{0, 0, 1, 2});
    CHECK(values<std::int32_t>(cells, "surface_count") == Ints{1, 2, 1, 1});
    CHECK(values<std::int32_t>(cells, "region") == Ints{0, 1, 2, 3});
    CHECK(values<std::int32_t>(cells, "parent") == Ints{7, 8, 10, 11});
    CHECK(values<std::int32_t>(cells, "volume <1>") == Ints{4, 3, 2, 1});
    CHECK(values<double>(cells, "quality") == std::vector<double>{0.5, 0.25, 1, 0});
    const auto points = values<double>(piece.child("Points"), "Points");
    REQUIRE(points.size() == 18);
    for (std::size_t v = 0; v < 6; ++v)
        CHECK(same_bits({points[3 * v], points[3 * v + 1], points[3 * v + 2]}, mesh.vertices[v]));
    CHECK(values<std::int64_t>(piece.child("Polys"), "connectivity") ==
          Longs{0, 1, 2, 1, 4, 2, 5, 4, 0, 0, 0, 5});
    CHECK(values<std::int64_t>(piece.child("Polys"), "offsets") == Longs{3, 6, 9, 12});
}

TEST_CASE("VTP: no lists, no arrays", "[io][vtk]") {
    auto mesh = awkward_mesh();
    mesh.regions_of = {};
    mesh.parents_of = {};
    const auto text = to_vtp(mesh, false).value();
    CHECK(text.find("Name=\"region\"") == std::string::npos);
    CHECK(text.find("Name=\"parent\"") == std::string::npos);
}

TEST_CASE("VTU: what is in it", "[io][vtk]") {
    const auto text = to_vtu(two_tetrahedra(), false);
    REQUIRE(text);
    pugi::xml_document xml;
    REQUIRE(xml.load_string(text.value().c_str()));
    const auto grid = xml.child("VTKFile").child("UnstructuredGrid");
    const auto field = grid.child("FieldData");
    CHECK_FALSE(field.child("Array")); // meshio refuses arrays of strings
    CHECK(strings(field, "surface_name", "DataArray").at(0) == "fault & <co>");
    CHECK(field.child("DataArray").attribute("NumberOfTuples").as_uint() ==
          std::size_t(std::ranges::count(std::string(field.child("DataArray").text().get()), ' ') +
                      std::ranges::count(std::string(field.child("DataArray").text().get()), '\n') -
                      1));
    const auto piece = grid.child("Piece");
    CHECK(piece.attribute("NumberOfCells").as_int() == 4);
    const auto cells = piece.child("CellData");
    CHECK(values<std::int32_t>(cells, "block") == Ints{0, 2, -1, -1});
    CHECK(values<std::int32_t>(cells, "surface") == Ints{-1, -1, 0, 2});
    CHECK(values<std::int32_t>(cells, "surface_count") == Ints{0, 0, 2, 1});
    CHECK(values<std::int32_t>(cells, "parent") == Ints{-1, -1, 5, -1});
    const auto topology = piece.child("Cells");
    CHECK(values<std::int64_t>(topology, "connectivity") ==
          Longs{0, 1, 2, 3, 0, 2, 1, 4, 0, 1, 2, 0, 1, 3});
    CHECK(values<std::int64_t>(topology, "offsets") == Longs{4, 8, 11, 14});
    CHECK(values<std::uint8_t>(topology, "types") == std::vector<std::uint8_t>{10, 10, 5, 5});
}

TEST_CASE("VTK: names of blocks", "[io][vtk]") {
    const std::vector<std::string> names{"outside", "", "a <b>, \"c\""};
    pugi::xml_document polygons, grid;
    REQUIRE(polygons.load_string(to_vtp(awkward_mesh(), false, {}, names).value().c_str()));
    REQUIRE(grid.load_string(to_vtu(two_tetrahedra(), false, {}, names).value().c_str()));
    const auto of_polygons = polygons.child("VTKFile").child("PolyData").child("FieldData");
    CHECK(strings(of_polygons, "block_name") == names);
    const auto of_grid = grid.child("VTKFile").child("UnstructuredGrid").child("FieldData");
    CHECK(strings(of_grid, "block_name", "DataArray") == names);
}

TEST_CASE("VTK: a cell array has one value per cell", "[io][vtk]") {
    const std::vector<CellArray> wrong{{"quality", std::vector<double>(3)}};
    for (const auto& result :
         {to_vtp(awkward_mesh(), true, wrong), to_vtu(two_tetrahedra(), true, wrong)}) {
        CHECK(message_of(result) == "cell array quality has 3 values for 4 cells");
        CHECK(result.error().code == ErrorCode::bad_option);
    }
}

TEST_CASE("VTU: a face of a cut names the one on the other side", "[io][vtk]") {
    const auto cells_of = [](const TetrahedralMesh& mesh) {
        pugi::xml_document xml;
        REQUIRE(xml.load_string(to_vtu(mesh, false).value().c_str()));
        pugi::xml_document cells;
        cells.append_copy(
            xml.child("VTKFile").child("UnstructuredGrid").child("Piece").child("CellData"));
        return cells;
    };
    const auto cut = cells_of(cut_tetrahedra());
    CHECK(values<std::int32_t>(cut.child("CellData"), "twin") == Ints{-1, -1, 4, -1, 2});
    CHECK(values<std::int32_t>(cut.child("CellData"), "cut_side") == Ints{0, 0, 1, 0, 2});
    CHECK(to_vtu(two_tetrahedra(), false).value().find("twin") == std::string::npos);
}
