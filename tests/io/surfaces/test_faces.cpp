// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Faces with more than three corners, in each format that has them.
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/io/meshes/gmsh_reader.hpp>
#include <terrane/io/meshes/legacy_vtk.hpp>
#include <terrane/io/meshes/vtp_reader.hpp>
#include <terrane/io/surfaces/obj.hpp>
#include <terrane/io/surfaces/off.hpp>
#include <terrane/io/surfaces/ply.hpp>

namespace faces_of_files_test {

using namespace terrane;

namespace {

/// The only surface of a file.
Surface only(const Result<std::vector<Surface>>& read) {
    REQUIRE(read);
    REQUIRE(read.value().size() == 1);
    return read.value()[0];
}

/// The sum of the areas of all triangles: more than that of the face where they overlap.
double area_of(const Surface& surface) {
    double twice = 0;
    for (const auto& [a, b, c] : surface.triangles) {
        const auto& v = surface.vertices;
        twice += length(cross(minus(v[b], v[a]), minus(v[c], v[a])));
    }
    return twice / 2;
}

/// A square of 10 without a quarter, from a corner from which the fan overlaps itself.
const std::string l_points = "0 10 0\n0 0 0\n10 0 0\n10 5 0\n5 5 0\n5 10 0\n";

std::string each_line_after(const std::string& word) {
    std::string text = word + " ";
    for (std::size_t i = 0; i + 1 < l_points.size(); ++i) {
        text += l_points[i];
        if (l_points[i] == '\n') text += word + " ";
    }
    return text + "\n";
}

} // namespace

TEST_CASE("faces: an L has its area in OBJ, OFF, PLY, VTP, VTU and legacy VTK") {
    const std::string corners = "0 1 2 3 4 5";
    const auto check = [](const Result<std::vector<Surface>>& read) {
        const Surface surface = only(read);
        CHECK(surface.triangles.size() == 4);
        CHECK(area_of(surface) == 75);
        CHECK(surface.flawed_faces.crossing + surface.flawed_faces.bent == 0);
    };
    check(read_obj(each_line_after("v") + "f 1 2 3 4 5 6\n", "L", "L"));
    check(read_obj("f 1 2 3 4 5 6\n" + each_line_after("v"), "L", "L"));
    check(read_off("OFF\n6 1 0\n" + l_points + "6 " + corners + "\n", "L", "L"));
    check(read_ply("ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\n"
                   "property double z\nelement face 1\nproperty list int int vertex_indices\n"
                   "end_header\n" +
                       l_points + "6 " + corners + "\n",
                   "L", "L"));
    const std::string points = "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
                               "format=\"ascii\">" +
                               l_points + "</DataArray></Points>";
    const auto array = [](const std::string& type, const std::string& name,
                          const std::string& text) {
        return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + text +
               "</DataArray>";
    };
    const std::string cell =
        array("Int32", "connectivity", corners) + array("Int32", "offsets", "6");
    check(
        read_vtp("<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><Piece NumberOfPoints=\"6\" "
                 "NumberOfPolys=\"1\">" +
                     points + "<Polys>" + cell + "</Polys></Piece></PolyData></VTKFile>",
                 "L", "L"));
    check(read_vtu("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><Piece "
                   "NumberOfPoints=\"6\" NumberOfCells=\"1\">" +
                       points + "<Cells>" + cell + array("UInt8", "types", "7") +
                       "</Cells></Piece></UnstructuredGrid></VTKFile>",
                   "L", "L"));
    check(read_vtk("# vtk DataFile Version 3.0\nL\nASCII\nDATASET POLYDATA\nPOINTS 6 double\n" +
                       l_points + "POLYGONS 1 7\n6 " + corners + "\n",
                   "L", "L"));
}

TEST_CASE("faces: a concave quadrilateral of MSH is divided at its inner corner") {
    const Surface surface =
        only(read_msh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 4 0 0\n3 1 1 0\n"
                      "4 0 4 0\n$EndNodes\n$Elements\n1\n1 3 2 0 1 2 3 4 1\n$EndElements\n",
                      "q", "q"));
    CHECK(area_of(surface) == 4);
}

TEST_CASE("faces: those that cross themselves or are not flat are warned of, with their numbers "
          "and the first") {
    const Surface surface = only(read_off("OFF\n9 3 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n"
                                          "5 0 0\n9 0 0\n9 4 0\n7 4 1\n5 4 0\n"
                                          "3 0 1 2\n4 3 0 1 2\n5 4 5 6 7 8\n",
                                          "bow", "bow"));
    CHECK(surface.flawed_faces.crossing == 1);
    CHECK(surface.flawed_faces.bent == 1);
    CHECK(surface.flawed_faces.first == Point3{0, 1, 0});
    const auto warnings = find_doubts(std::vector{surface}, {});
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].doubt == Doubt::flawed_faces);
    CHECK(warnings[0].seen ==
          "bow has faces with more than three corners that cross themselves (1) "
          "or are not flat (1), the first one at (0, 1, 0)");
}

} // namespace faces_of_files_test
