// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Values on points and triangles: files have them and get them; a warning names what is not read.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/text/values.hpp>

namespace values_of_files_test {

using namespace terrane;
using Names = std::vector<std::string>;

namespace {

Surface surface_in(const std::string& contents, Format format) {
    const auto read = parse_surfaces(contents, "file", format);
    REQUIRE(read);
    REQUIRE(read->size() == 1);
    return read->front();
}

/// Returns the names of values that a file has and that are not read.
Names values_in(const std::string& contents, Format format) {
    return surface_in(contents, format).values;
}

/// Returns the values of a file: "name: numbers" per array, with the type unless it is float64.
Names arrays_in(const std::string& contents, Format format) {
    Names all;
    for (const ValueArray& a : surface_in(contents, format).arrays) {
        std::string text = a.name + (a.on_triangles ? " of triangles" : "") + ":";
        for (std::size_t i = 0; i < a.size() * a.components; ++i) {
            text += ' ';
            detail::append_value(text, a, i);
        }
        all.push_back(text +
                      (a.type == NumberType::float64 ? "" : " " + std::string(name_of(a.type))));
    }
    return all;
}

std::string vtp_with(const std::string& data) {
    const auto array = [](const std::string& type, const std::string& attributes,
                          const std::string& text) {
        return "<DataArray type=\"" + type + "\" " + attributes + " format=\"ascii\">" + text +
               "</DataArray>";
    };
    return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\"><Points>" +
           array("Float64", "NumberOfComponents=\"3\"", "0 0 0 1 0 0 0 1 0") + "</Points><Polys>" +
           array("Int32", "Name=\"connectivity\"", "0 1 2") +
           array("Int32", "Name=\"offsets\"", "3") + "</Polys>" + data +
           "</Piece></PolyData></VTKFile>";
}

const std::string legacy =
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
    "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
const std::string msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
    "$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n";

} // namespace

TEST_CASE("values: each format that has them gives them") {
    const std::string properties = "PROPERTIES Poro  \" net to gross\" Z flow\nESIZES 1 1 1 3\n"
                                   "UNITS none \"m 3\" m m\nNO_DATA_VALUES -99999 -1 x -99999\n";
    const std::string ts = "GOCAD TSurf 1\nHEADER {\nname:a\n}\n" + properties +
                           "TFACE\nPVRTX 1 0 0 0 .2 .5 7 1 2 3 CNXYZ\nVRTX 2 1 0 0\n"
                           "PVRTX 3 0 1 0 -99999 nan 1e38 4\nATOM 4 1\nTRGL 1 2 3\nEND\n";
    const Names meant{"Poro: 0.2 nan -99999", "net to gross: 0.5 nan nan", "Z: 7 nan 1e+38",
                      "flow: 1 2 3 nan nan nan 4 nan nan"};
    CHECK(arrays_in(ts, Format::gocad) == meant);
    const auto arrays = surface_in(ts, Format::gocad).arrays;
    CHECK(arrays[0].no_data == -99999);
    CHECK(arrays[1].unit == "m 3");
    CHECK(arrays[1].no_data == -1);
    CHECK_FALSE(arrays[2].no_data);
    CHECK(arrays[3].components == 3);
    const std::string vs = "GOCAD VSet 1\n" + ts.substr(ts.find("HEADER"));
    CHECK(arrays_in(vs.substr(0, vs.find("ATOM")) + "END\n", Format::vset) == meant);
    const std::string csv = "x_m;y_m;Elevation;Poro;rock type;mixed;thick_ft\n0;0;0;.5;clay;1;2\n"
                            "1;0;0;;sand;a;3\n0;1;0;.25;clay;2\n0;9;-9999;7;chalk;2;2\n";
    CHECK(arrays_in(csv, Format::xyz) ==
          Names{"Poro: 0.5 nan 0.25", "rock type: 0 1 0 int32", "thick: 2 3 nan"});
    CHECK(values_in(csv, Format::xyz) == Names{"mixed"});
    const auto columns = surface_in(csv, Format::xyz).arrays;
    CHECK(columns[1].texts == Names{"clay", "sand"});
    CHECK(columns[2].unit == "ft");
    CHECK(arrays_in("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nproperty float quality\nelement face 1\n"
                    "property list uchar int vertex_indices\nproperty uchar red\nelement edge 0\n"
                    "property int v1\nend_header\n0 0 0 1\n1 0 0 nan\n0 1 0 .5\n3 0 1 2 9\n",
                    Format::ply) ==
          Names{"quality: 1 nan 0.5 float32", "red of triangles: 9 uint8"});
    CHECK(arrays_in(
              vtp_with("<PointData><DataArray type=\"Float32\" Name=\"Poro\" format=\"ascii\">1 2 "
                       "3</DataArray></PointData><CellData><DataArray type=\"Int8\" "
                       "Name=\"code\" format=\"ascii\">1</DataArray></CellData>"),
              Format::vtp) == Names{"Poro: 1 2 3 float32", "code of triangles: 1 int8"});
    CHECK(arrays_in(legacy + "POINT_DATA 3\nSCALARS Poro float\nLOOKUP_TABLE default\n1 2 3\n"
                             "FIELD more 1\nnet%20to%20gross 1 3 double\n1 2 3\nCELL_DATA 1\n"
                             "VECTORS flow float\n1 2 3\n",
                    Format::vtk) ==
          Names{"Poro: 1 2 3 float32", "net to gross: 1 2 3", "flow of triangles: 1 2 3 float32"});
    CHECK(arrays_in(msh + "$NodeData\n1\n\"Poro\"\n1\n0.0\n3\n0\n1\n2\n3 .5\n1 .25\n$EndNodeData\n"
                          "$ElementData\n1\n\"code\"\n1\n0.0\n3\n0\n1\n1\n1 4\n$EndElementData\n",
                    Format::msh) == Names{"Poro: 0.25 nan 0.5", "code of triangles: 4"});
}

TEST_CASE("values: formats name what is not read of them") {
    CHECK(values_in("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\nf 1/1 2/1 3/1\n",
                    Format::obj) == Names{"colours", "texture coordinates"});
    CHECK(values_in("COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n",
                    Format::off) == Names{"colours"});
    // wrong counts
    const auto array = [](const std::string& data, const std::string& text) {
        return vtp_with("<" + data +
                        "><DataArray type=\"Float64\" Name=\"a b\" "
                        "format=\"ascii\">" +
                        text + "</DataArray></" + data + ">");
    };
    for (const std::string& file : {array("PointData", "1 2"), array("PointData", "1 2 3 4"),
                                    array("CellData", "1 2"), array("CellData", "x")}) {
        CHECK(values_in(file, Format::vtp) == Names{"a b"});
        CHECK(arrays_in(file, Format::vtp).empty());
    }
    CHECK(values_in(msh + "$NodeData\n1\n\"Poro\"\n1\n0.0\n3\n0\n1\n1\n1 x\n$EndNodeData\n",
                    Format::msh) == Names{"Poro"});
    CHECK(values_in(legacy + "POINT_DATA 3\nTEXTURE_COORDINATES uv 2 float\n0 0 0 0 0 0\n",
                    Format::vtk) == Names{"uv"});
}

TEST_CASE("values: repeated names are told apart") {
    const std::string a =
        "<DataArray type=\"Float64\" Name=\"a\" format=\"ascii\">1 2 3</DataArray>";
    CHECK(arrays_in(vtp_with("<PointData>" + a + a + a + "</PointData>"), Format::vtp) ==
          Names{"a: 1 2 3", "a_2: 1 2 3", "a_3: 1 2 3"});
}

TEST_CASE("values: a file without any has none, and damage after the triangles is no error") {
    CHECK(values_in("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Format::obj).empty());
    CHECK(values_in("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n", Format::obj).empty()); // a weight
    CHECK(arrays_in(vtp_with(""), Format::vtp).empty());
    CHECK(arrays_in(legacy, Format::vtk).empty());
    CHECK(arrays_in(legacy + "POINT_DATA 3\nSCALARS Poro float\nLOOKUP_TABLE default\n1 2 x\n",
                    Format::vtk)
              .empty());
    CHECK(arrays_in(msh, Format::msh).empty());
}

namespace {

/// Two triangles with arrays of all kinds.
Surface with_arrays() {
    Surface s;
    s.name = "top";
    s.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}};
    s.triangles = {{0, 1, 2}, {1, 3, 2}};
    s.arrays = {{.name = "net to gross",
                 .numbers = std::vector<double>{0.1, 1e-300, -99999, 0.3},
                 .unit = "m 3",
                 .no_data = -99999},
                {.name = "flow",
                 .components = 3,
                 .type = NumberType::float32,
                 .numbers = std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0.25}},
                {.name = "code",
                 .on_triangles = true,
                 .type = NumberType::int16,
                 .numbers = std::vector<std::int64_t>{-5, 300}},
                {.name = "z",
                 .type = NumberType::uint8,
                 .numbers = std::vector<std::int64_t>{0, 255, 1, 0}}};
    return s;
}

std::string written_as(const Surface& s, Format format) {
    const auto values = values_of(std::span(&s, 1));
    const auto written = format_mesh(concatenate(std::span(&s, 1)), format, {.values = values});
    REQUIRE(written);
    return *written;
}

} // namespace

TEST_CASE("values: what is written reads back as the same, with types, units and no-data numbers") {
    const Surface s = with_arrays();
    for (const Format format : {Format::ply, Format::vtp, Format::vtk}) {
        CAPTURE(static_cast<int>(format));
        auto arrays = surface_in(written_as(s, format), format).arrays;
        auto meant = s.arrays;
        for (auto* list : {&arrays, &meant}) std::ranges::sort(*list, {}, &ValueArray::name);
        CHECK(arrays == meant);
        CHECK(values_left_out(format, values_of(std::span(&s, 1))).empty());
    }
    const auto gocad = surface_in(written_as(s, Format::gocad), Format::gocad).arrays;
    REQUIRE(gocad.size() == 3);
    CHECK(gocad[0] == s.arrays[0]);
    CHECK(gocad[1].numbers == s.arrays[1].numbers);
    CHECK(gocad[2].numbers == decltype(ValueArray::numbers)(std::vector<double>{0, 255, 1, 0}));
    const auto msh41 = arrays_in(written_as(s, Format::msh), Format::msh);
    CHECK(msh41 == Names{"net to gross: 0.1 1e-300 nan 0.3", "flow: 1 2 3 4 5 6 7 8 9 10 11 0.25",
                         "code of triangles: -5 300", "z: 0 255 1 0"});
    CHECK(msh41 == arrays_in(written_as(s, Format::msh22), Format::msh));
    CHECK(values_left_out(Format::gocad, values_of(std::span(&s, 1))) == Names{"code"});
    CHECK(values_left_out(Format::off, values_of(std::span(&s, 1))) ==
          Names{"net to gross", "flow", "code", "z"});
}

TEST_CASE("values: integers of 64 bits and texts keep all digits in VTK files") {
    Surface s = with_arrays();
    s.arrays = {{.name = "big",
                 .on_triangles = true,
                 .type = NumberType::int64,
                 .numbers = std::vector<std::int64_t>{INT64_MIN, INT64_MAX}},
                {.name = "huge",
                 .on_triangles = true,
                 .type = NumberType::uint64,
                 .numbers = std::vector<std::int64_t>{-1, 3}}};
    CHECK(surface_in(written_as(s, Format::vtp), Format::vtp).arrays == s.arrays);
    s.arrays.pop_back();
    CHECK(surface_in(written_as(s, Format::vtk), Format::vtk).arrays == s.arrays);
    s.arrays = {{.name = "rock",
                 .on_triangles = true,
                 .type = NumberType::int32,
                 .numbers = std::vector<std::int64_t>{1, 0},
                 .texts = {"clay", "sand & \"gravel\""}}};
    const auto rock = surface_in(written_as(s, Format::vtp), Format::vtp).arrays;
    REQUIRE(rock.size() == 1);
    CHECK(rock[0].texts == Names{"sand & \"gravel\"", "clay"});
    CHECK(std::get<1>(rock[0].numbers) == std::vector<std::int64_t>{0, 1});
}

TEST_CASE("values: surfaces that share vertices and names keep their own in GOCAD, the first has "
          "them elsewhere") {
    Mesh mesh;
    mesh.surfaces = {{"a"}, {"b"}, {"c"}};
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 1}, {0, 0, 9}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    for (const std::uint32_t s : {0, 1, 2}) mesh.surfaces_of.push_back(std::array{s});
    const auto array = [](std::vector<double> numbers) {
        return ValueArray{.name = "v", .numbers = std::move(numbers)};
    };
    const std::vector<SurfaceValues> values{{array({1, 2, 3})}, {array({4, 5, 6})}, {}};
    const auto read = [&](Format format) {
        auto all = parse_surfaces(*format_mesh(mesh, format, {.values = values}), "f", format);
        REQUIRE(all);
        REQUIRE(all->size() == 3);
        return *all;
    };
    using Numbers = std::vector<double>;
    const auto gocad = read(Format::gocad);
    CHECK(std::get<0>(gocad[0].arrays.at(0).numbers) == Numbers{1, 2, 3});
    CHECK(std::get<0>(gocad[1].arrays.at(0).numbers) == Numbers{4, 5, 6});
    CHECK(gocad[2].arrays.empty());
    for (const Format format : {Format::vtp, Format::ply, Format::vtk}) {
        const auto all = read(format);
        CHECK(std::get<0>(all[0].arrays.at(0).numbers) == Numbers{1, 2, 3});
        CHECK(std::get<0>(all[1].arrays.at(0).numbers) == Numbers{1, 2, 6});
        const auto& c = std::get<0>(all[2].arrays.at(0).numbers);
        CHECK((c[0] == 1 && c[1] == 2 && std::isnan(c[2])));
    }
}

TEST_CASE("values: what Terrane writes names none of its own") {
    Mesh mesh;
    mesh.surfaces = {{"top", Role::horizon}};
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    mesh.parents_of = mesh.regions_of = mesh.surfaces_of;
    for (const Format format : {Format::gocad, Format::obj, Format::off, Format::stl, Format::ply,
                                Format::vtp, Format::msh, Format::vtk}) {
        const auto written = format_mesh(mesh, format);
        REQUIRE(written);
        CHECK(values_in(*written, format).empty());
        CHECK(arrays_in(*written, format).empty());
    }
}

TEST_CASE("values: at most 64 arrays are read") {
    std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                         "property float y\nproperty float z\n",
                numbers;
    for (int i = 0; i < 70; ++i) {
        header += "property float a" + std::to_string(i) + "\n";
        numbers += " 0";
    }
    header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string ply =
        header + "0 0 0" + numbers + "\n1 0 0" + numbers + "\n0 1 0" + numbers + "\n3 0 1 2\n";
    CHECK(arrays_in(ply, Format::ply).size() == 64);
    CHECK(values_in(ply, Format::ply) == Names{"a64", "a65", "a66", "a67", "a68", "a69"});
}

TEST_CASE("values: one warning names all surfaces and values") {
    Surface a, b, c;
    a.name = "a";
    a.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    a.triangles = {{0, 1, 2}};
    b = c = a;
    b.name = "b";
    for (Point3& p : b.vertices) p.z = 1;
    c.name = "c";
    for (Point3& p : c.vertices) p.z = 2;
    a.values = {"Poro", "Perm"};
    c.values = {"Perm", "code"};
    const auto found = find_doubts(std::vector{a, b, c});
    REQUIRE(found.size() == 1);
    CHECK(found[0].doubt == Doubt::values_left_out);
    CHECK(found[0].surfaces == std::vector<SurfaceId>{SurfaceId(0), SurfaceId(2)});
    CHECK(found[0].seen == "a and c have values that are not read: Poro, Perm, code");
}

} // namespace values_of_files_test
