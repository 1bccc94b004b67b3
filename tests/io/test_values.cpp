// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Values on points and triangles: files name them, and a warning says that they are left out.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/io/files.hpp>

namespace values_of_files_test {

using namespace terrane;
using Names = std::vector<std::string>;

namespace {

Names values_in(const std::string& contents, Format format) {
    const auto read = parse_surfaces(contents, "file", format);
    REQUIRE(read);
    REQUIRE(read->size() == 1);
    return read->front().values;
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

TEST_CASE("values: each format that has them names them") {
    CHECK(values_in("GOCAD TSurf 1\nHEADER {\nname:a\n}\nPROPERTIES Poro  \" net to gross\" Z\n"
                    "ESIZES 1 1 1\nTFACE\nPVRTX 1 0 0 0 .2 .5 0\nPVRTX 2 1 0 0 .2 .5 0\n"
                    "PVRTX 3 0 1 0 .2 .5 0\nTRGL 1 2 3\nEND\n",
                    Format::gocad) == Names{"Poro", "net to gross"});
    CHECK(values_in("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nproperty float quality\nelement face 1\n"
                    "property list uchar int vertex_indices\nproperty uchar red\nelement edge 0\n"
                    "property int v1\nend_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2 9\n",
                    Format::ply) == Names{"quality", "red"});
    CHECK(values_in("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\nf 1/1 2/1 3/1\n",
                    Format::obj) == Names{"colours", "texture coordinates"});
    CHECK(values_in("COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n",
                    Format::off) == Names{"colours"});
    CHECK(values_in(
              vtp_with("<PointData><DataArray type=\"Float32\" Name=\"Poro\" format=\"ascii\">1 2 "
                       "3</DataArray></PointData><CellData><DataArray type=\"Int8\" "
                       "Name=\"code\" format=\"ascii\">1</DataArray></CellData>"),
              Format::vtp) == Names{"Poro", "code"});
    CHECK(values_in(legacy + "POINT_DATA 3\nSCALARS Poro float\nLOOKUP_TABLE default\n1 2 3\n"
                             "FIELD more 1\nthick 1 3 double\n1 2 3\nCELL_DATA 1\nVECTORS flow "
                             "float\n1 2 3\n",
                    Format::vtk) == Names{"Poro", "thick", "flow"});
    CHECK(values_in(msh + "$NodeData\n1\n\"Poro\"\n1\n0.0\n3\n0\n1\n0\n$EndNodeData\n",
                    Format::msh) == Names{"Poro"});
}

TEST_CASE("values: a file without any names none, and damage after the triangles is no error") {
    CHECK(values_in("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Format::obj).empty());
    CHECK(values_in("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n", Format::obj).empty()); // a weight
    CHECK(values_in(vtp_with(""), Format::vtp).empty());
    CHECK(values_in(legacy, Format::vtk).empty());
    CHECK(values_in(legacy + "POINT_DATA 3\nSCALARS Poro float\nLOOKUP_TABLE default\n1 2 x\n",
                    Format::vtk) == Names{"Poro"});
    CHECK(values_in(msh, Format::msh).empty());
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
    }
}

TEST_CASE("values: at most 64 names are kept, on one line each") {
    std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                         "property float y\nproperty float z\n",
                numbers;
    for (int i = 0; i < 70; ++i) {
        header += "property float a" + std::to_string(i) + "\n";
        numbers += " 0";
    }
    header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    CHECK(values_in(header + "0 0 0" + numbers + "\n1 0 0" + numbers + "\n0 1 0" + numbers +
                        "\n3 0 1 2\n",
                    Format::ply)
              .size() == 64);
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
    CHECK(found[0].seen == "a and c have values on points or triangles: Poro, Perm, code");
}

} // namespace values_of_files_test
