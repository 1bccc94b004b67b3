// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading VTP, legacy VTK and MSH: files of other programs (tests/data/other_programs), files that
// the library wrote, and broken ones.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>

#include "support/files.hpp"
#include "support/paths.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

std::string other(const std::string& name) {
    return test_data() + "/other_programs/" + name;
}

/// The corners of each triangle, which do not depend on numbers; triangles are in order.
std::vector<std::array<Point3, 3>> places_of(const Surface& s) {
    std::vector<std::array<Point3, 3>> all;
    for (const Triangle& t : s.triangles)
        all.push_back({s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]});
    return all;
}

/// The roof that tests/data/other_programs/make.py writes.
std::vector<std::array<Point3, 3>> roof() {
    const Point3 a{0, 0, 0}, b{2, 0, 0}, c{2, 1, 0.5}, d{0, 1, 0.5}, e{0, 2, 0.1}, f{2, 2, 0.1};
    return {{a, b, c}, {a, c, d}, {d, c, e}, {e, c, f}};
}

void check_error(const std::string& contents, Format format, ErrorCode code,
                 const std::string& message) {
    const auto read = parse_surfaces(contents, "a", format);
    INFO(contents);
    REQUIRE_FALSE(read);
    CHECK(read.error().code == code);
    CHECK(read.error().message() == message);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("VTP: files of VTK in every encoding", "[io][vtk]") {
    for (const std::string name : {"ascii", "binary", "binary_zlib", "appended", "appended_raw",
                                   "appended_raw_zlib", "appended_zlib", "big_endian"}) {
        const auto read = read_surfaces(other("vtk_" + name + ".vtp"));
        INFO(name);
        if (!read) FAIL(read.error().message());
        REQUIRE(read->size() == 1);
        CHECK(read->front().name == "vtk_" + name);
        CHECK(read->front().vertices.size() == 6);
        CHECK(places_of(read->front()) == roof());
    }
}

TEST_CASE("VTP: blocks compressed by LZ4 and LZMA, where their libraries are there", "[io][vtk]") {
    for (const std::string name : {"lz4", "lzma"}) {
        const auto path = other("vtk_" + name + ".vtp");
        const auto read = read_surfaces(path);
        INFO(name);
        if (!read) {
            CHECK(read.error().code == ErrorCode::unsupported);
            WARN(read.error().message());
            continue;
        }
        CHECK(places_of(read->front()) == roof());
        // A block that was changed or cut off is an error or other numbers, never a crash.
        const std::string whole = read_file(path).value();
        for (std::size_t n = whole.find("<AppendedData"); n < whole.size(); ++n)
            (void)parse_surfaces(whole.substr(0, n), "a", Format::vtp);
        if (name == "lzma") // which has checksums
            CHECK_FALSE(parse_surfaces(replaced(whole, "ohPv3i5", "ohPv4i5"), "a", Format::vtp));
    }
}

TEST_CASE("VTU: the faces among the cells, in files of VTK and meshio", "[io][vtk]") {
    for (const std::string name : {"vtk_ascii", "vtk_binary_zlib", "vtk_appended_raw", "meshio"}) {
        const auto read = read_surfaces(other(name + ".vtu"));
        INFO(name);
        if (!read) FAIL(read.error().message());
        REQUIRE(read->size() == 1);
        CHECK(read->front().name == name);
        CHECK(places_of(read->front()) == roof());
    }
}

TEST_CASE("VTU: tetrahedra that are written give their surfaces back", "[io][vtk]") {
    const TetrahedralMesh mesh = two_tetrahedra();
    for (const bool compress : {false, true}) {
        TemporaryFolder folder;
        const auto file = folder / "a.vtu";
        REQUIRE(write_tetrahedra(mesh, file, {.compress = compress}));
        const auto read = read_surfaces(file);
        if (!read) FAIL(read.error().message());
        std::vector<std::vector<std::array<Point3, 3>>> wanted(mesh.surfaces.size());
        for (std::size_t f = 0; f < mesh.faces.size(); ++f)
            for (const auto s : mesh.surfaces_of[f])
                wanted[s].push_back({mesh.vertices[mesh.faces[f][0]],
                                     mesh.vertices[mesh.faces[f][1]],
                                     mesh.vertices[mesh.faces[f][2]]});
        std::size_t found = 0;
        for (std::size_t s = 0; s < wanted.size(); ++s) {
            if (wanted[s].empty()) continue;
            REQUIRE(found < read->size());
            const Surface& surface = (*read)[found++];
            CHECK(surface.name == mesh.surfaces[s].name);
            CHECK(surface.role == mesh.surfaces[s].role);
            CHECK(places_of(surface) == wanted[s]);
        }
        CHECK(found == read->size());
    }
}

TEST_CASE("VTU: what can't be read is named with its line", "[io][vtk]") {
    using enum ErrorCode;
    const std::string good = read_file(other("vtk_ascii.vtu")).value();
    REQUIRE(parse_surfaces(good, "a", Format::vtu));
    check_error("<VTKFile type=\"PolyData\"/>", Format::vtu, unsupported,
                "a:1: the file has \"PolyData\"; only UnstructuredGrid is read");
    check_error("<VTKFile type=\"UnstructuredGrid\"/>", Format::vtu, bad_syntax,
                "a:1: there is no element UnstructuredGrid");
    const std::string types = "10 3 8 1 5 5";
    check_error(replaced(good, types, "10 3 1 1 3 3"), Format::vtu, nothing_to_do,
                "a: there is no triangle, only 6 other cells; ParaView's Extract Surface makes "
                "triangles of them");
    check_error(replaced(good, types, "10 3 8 1 22 5"), Format::vtu, unsupported,
                "a:33: cell 4 is of type 22, with curved sides, which is not read");
    check_error(replaced(good, types, "10 3 8 1 5"), Format::vtu, bad_index,
                "a:24: the array types has no value for cell 5");
    check_error(replaced(good, "0 1 2 3 0 1", "0 1 2 3 0 6"), Format::vtu, bad_index,
                "a:25: cell 1 names point 6, but there are 6");
}

TEST_CASE("legacy VTK: files of VTK, text and binary, old and new", "[io][vtk]") {
    for (const std::string name : {"ascii_42", "binary_42", "ascii_51", "binary_51_strip"}) {
        const auto read = read_surfaces(other("vtk_" + name + ".vtk"));
        INFO(name);
        if (!read) FAIL(read.error().message());
        REQUIRE(read->size() == 1);
        CHECK(read->front().name == "vtk_" + name);
        CHECK(places_of(read->front()) == roof()); // the second triangle of a strip is turned back
    }
}

TEST_CASE("legacy VTK: the faces of unstructured grids of VTK and meshio", "[io][vtk]") {
    for (const std::string name : {"vtk_grid_ascii_42", "vtk_grid_binary_42", "vtk_grid_ascii_51",
                                   "vtk_grid_binary_51", "meshio_ascii", "meshio_binary"}) {
        const auto read = read_surfaces(other(name + ".vtk"));
        INFO(name);
        if (!read) FAIL(read.error().message());
        REQUIRE(read->size() == 1);
        CHECK(read->front().name == name);
        CHECK(places_of(read->front()) == roof());
    }
}

TEST_CASE("legacy VTK: names of surfaces in files that VTK made of others", "[io][vtk]") {
    const auto all = roof();
    for (const std::string kind : {"named_grid_", "named_"})
        for (const std::string name : {"ascii_42", "binary_42", "ascii_51", "binary_51"}) {
            const auto read = read_surfaces(other("vtk_" + kind + name + ".vtk"));
            INFO(kind << name);
            if (!read) FAIL(read.error().message());
            REQUIRE(read->size() == 2);
            CHECK(read->at(0).name == "west flank");
            CHECK(read->at(0).role == Role::horizon);
            CHECK(places_of(read->at(0)) ==
                  std::vector<std::array<Point3, 3>>{all[0], all[1], all[3]});
            CHECK(read->at(1).name == "F%1");
            CHECK(read->at(1).role == Role::fault);
            CHECK(places_of(read->at(1)) == std::vector<std::array<Point3, 3>>{all[2]});
        }
}

TEST_CASE("MSH: files of gmsh and meshio", "[io][msh]") {
    for (const std::string name : {"gmsh_41.msh", "gmsh_22.msh"}) {
        const auto read = read_surfaces(other(name));
        INFO(name);
        if (!read) FAIL(read.error().message());
        REQUIRE(read->size() == 2);
        CHECK(read->at(0).name == "west");
        CHECK(read->at(1).name == "east flank");
        CHECK(read->at(0).triangles.size() == 4);
        CHECK(read->at(1).triangles.size() == 8);
        double area = 0; // the west is a unit square in the plane z = 0
        for (const auto& [a, b, c] : places_of(read->at(0))) {
            CHECK((a.z == 0 && b.z == 0 && c.z == 0));
            area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
        }
        CHECK(area == Approx(1));
    }
    const auto quads = read_surfaces(other("meshio_22.msh"));
    REQUIRE(quads);
    REQUIRE(quads->size() == 1);
    CHECK(quads->front().name == "meshio_22");
    CHECK(places_of(quads->front()) == roof());
    const auto triangles = read_surfaces(other("meshio_41.msh"));
    REQUIRE(triangles);
    auto wanted = roof();
    wanted.erase(wanted.begin(), wanted.begin() + 2);
    CHECK(places_of(triangles->front()) == wanted);
    CHECK(read_surfaces(other("gmsh_binary.msh")).error().message() ==
          other("gmsh_binary.msh") +
              ":2: binary MSH is not read; gmsh FILE -save -o text.msh writes text");
}

TEST_CASE("VTP and MSH: what is written is read back", "[io][vtk][msh]") {
    const Mesh mesh = awkward_mesh();
    const auto meant = surfaces_of_mesh(mesh);
    const std::vector<std::string> quotable{"top reservoir", "main 'A' fault", "top reservoir_2"};
    for (const Format format : {Format::vtp, Format::msh, Format::msh22})
        for (const bool compress : {false, true}) {
            const auto text = format_mesh(mesh, format, {.compress = compress});
            REQUIRE(text);
            const auto read =
                parse_surfaces(*text, "a", format == Format::vtp ? format : Format::msh);
            if (!read) FAIL(read.error().message());
            REQUIRE(read->size() == meant.size());
            for (std::size_t s = 0; s < meant.size(); ++s) {
                const Surface& found = (*read)[s];
                auto there = places_of(found), wanted = places_of(meant[s]);
                if (format == Format::vtp) {
                    CHECK(found.name == meant[s].name);
                    CHECK(found.role == meant[s].role);
                    CHECK(found.vertices == meant[s].vertices);
                } else {
                    CHECK(found.name == quotable[s]);
                    std::sort(there.begin(), there.end()); // groups change the order
                    std::sort(wanted.begin(), wanted.end());
                }
                CHECK(there == wanted);
            }
        }
}

TEST_CASE("legacy VTK: what is written is read back", "[io][vtk]") {
    const Mesh mesh = awkward_mesh();
    const auto meant = surfaces_of_mesh(mesh);
    const auto text = format_mesh(mesh, Format::vtk);
    REQUIRE(text);
    const auto read = parse_surfaces(*text, "a", Format::vtk);
    if (!read) FAIL(read.error().message());
    REQUIRE(read->size() == meant.size());
    for (std::size_t s = 0; s < meant.size(); ++s) {
        CHECK((*read)[s].name == meant[s].name);
        CHECK((*read)[s].role == meant[s].role);
        CHECK((*read)[s].vertices == meant[s].vertices);
        CHECK(places_of((*read)[s]) == places_of(meant[s]));
    }
    const auto check = [&](const std::string& from, const std::string& to) {
        check_error(replaced(*text, from, to), Format::vtk, ErrorCode::bad_index,
                    "a: the lists of surfaces do not fit the triangles");
    };
    check("surfaces_offset 1 5 int\n0 1 3 4 5", "surfaces_offset 1 5 int\n0 1 3 4 6");
    check("surfaces_offset 1 5 int\n0 1 3 4 5", "surfaces_offset 1 5 int\n0 3 1 4 5");
    check("surfaces 1 5 int\n0 0 1 1 2", "surfaces 1 5 int\n0 0 1 1 3");
    check("surfaces_offset 1 5 int\n0 1 3 4 5", "other 1 5 int\n0 1 3 4 5");
}

TEST_CASE("VTP: what can't be read is named with its line", "[io][vtk]") {
    using enum ErrorCode;
    const std::string good = read_file(other("vtk_ascii.vtp")).value();
    REQUIRE(parse_surfaces(good, "a", Format::vtp));
    const auto check = [&](const std::string& from, const std::string& to, ErrorCode code,
                           const std::string& message) {
        check_error(replaced(good, from, to), Format::vtp, code, message);
    };
    check_error("", Format::vtp, bad_syntax,
                "a:1: this is not well-formed XML: No document "
                "element found");
    check_error("<a/>", Format::vtp, bad_syntax, "a:1: there is no element VTKFile");
    check_error("<VTKFile type=\"UnstructuredGrid\"/>", Format::vtp, unsupported,
                "a:1: the file has \"UnstructuredGrid\"; only PolyData is read");
    check_error("<VTKFile type=\"PolyData\" compressor=\"vtkX\"/>", Format::vtp, unsupported,
                "a:1: \"vtkX\" is not read by this build");
    check_error("<VTKFile type=\"PolyData\"><PolyData/></VTKFile>", Format::vtp, nothing_to_do,
                "a: there is no triangle");
    check("NumberOfPoints=\"6\"", "NumberOfPoints=\"7\"", bad_syntax,
          "a:10: 7 points call for 21 numbers, but there are 18");
    check("0 2 0.1", "0 2 inf", bad_number,
          "a:10: point 4 has a coordinate that is not a finite number");
    check("0 1 2 3 3 2", "0 1 2 9 3 2", bad_index, "a:43: cell 0 names point 9, but there are 6");
    check("4 7 10", "4 3 10", bad_index, "a:47: cell 1 ends at 3, which is not in its data");
    const std::string appended = read_file(other("vtk_appended_raw_zlib.vtp")).value();
    check_error(appended.substr(0, appended.size() - 80), Format::vtp, bad_syntax,
                "a:24: the data of the array end too soon, or are not base64");
}

TEST_CASE("VTP: base64 is padded, and bits that are no data are 0", "[io][vtk]") {
    for (const bool compress : {false, true}) {
        const auto text = format_mesh(awkward_mesh(), Format::vtp, {.compress = compress});
        REQUIRE(text);
        REQUIRE(parse_surfaces(*text, "a", Format::vtp));
        std::size_t paddings = 0;
        for (std::size_t k = text->find("<Points>"); k < text->find("</Points>"); ++k) {
            if ((*text)[k] != '=' || (*text)[k + 1] == '"') continue;
            ++paddings;
            std::string unpadded = *text, spare = *text;
            unpadded[k] = '5';
            CHECK_FALSE(parse_surfaces(unpadded, "a", Format::vtp));
            if (spare[k - 1] == '=') continue;
            ++spare[k - 1]; // its last two bits were 0
            CHECK_FALSE(parse_surfaces(spare, "a", Format::vtp));
        }
        CHECK(paddings > 0);
    }
}

TEST_CASE("legacy VTK: what can't be read is named with its place", "[io][vtk]") {
    using enum ErrorCode;
    const std::string start = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n";
    const std::string points = "POINTS 3 float\n0 0 0 1 0 0\n0 1 0\n";
    REQUIRE(parse_surfaces(start + points + "POLYGONS 1 4\n3 0 1 2\n", "a", Format::vtk));
    check_error("x", Format::vtk, bad_syntax,
                "a:1: the first line is not \"# vtk DataFile Version\"");
    check_error("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n", Format::vtk,
                unsupported,
                "a:4: the file has \"STRUCTURED_POINTS\"; only POLYDATA, UNSTRUCTURED_GRID and "
                "STRUCTURED_GRID are read");
    check_error(start + points, Format::vtk, nothing_to_do, "a: there is no triangle");
    check_error(start + "POINTS 99999 float\n", Format::vtk, bad_syntax,
                "a:5: 99999 elements are more than the file has bytes");
    check_error(start + "POINTS 3 float\n0 0 0 1 x 0\n", Format::vtk, bad_number,
                "a:6: \"x\" is not such a number");
    check_error(start + "POINTS 3 quad\n", Format::vtk, unsupported,
                "a:5: \"quad\" is no type of number that is read");
    check_error(start + points + "POLYGONS 1 4\n3 0 1 3\n", Format::vtk, bad_index,
                "a:8: cell 0 names point 3, but there are 3");
    check_error(start + points + "POLYGONS 2 4\n3 0 1 2\n", Format::vtk, bad_index,
                "a:8: cell 1 is not within the 4 numbers");
    check_error(start + "POINTS 3 float\n0 0", Format::vtk, bad_syntax,
                "a:6: the file ends within its numbers");
    const std::string binary = read_file(other("vtk_binary_42.vtk")).value();
    const auto read = parse_surfaces(binary.substr(0, 150), "a", Format::vtk);
    REQUIRE_FALSE(read);
    CHECK(read.error().code == bad_syntax);
    CHECK(read.error().place.starts_with("a, byte "));
}

TEST_CASE("legacy VTK: what can't be read of a grid is named with its place", "[io][vtk]") {
    using enum ErrorCode;
    const std::string start = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                              "POINTS 4 float\n0 0 0 1 0 0\n0 1 0 0 0 1\n";
    const std::string tetrahedron = "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
    const std::string cells = "CELLS 2 8\n3 0 1 2\n3 0 2 3\n", types = "CELL_TYPES 2\n5 5\n";
    REQUIRE(parse_surfaces(start + cells + types, "a", Format::vtk));
    check_error(start + tetrahedron, Format::vtk, nothing_to_do,
                "a: there is no triangle, only 1 other cells; ParaView's Extract Surface makes "
                "triangles of them");
    check_error(start + cells + "CELL_TYPES 2\n5 22\n", Format::vtk, unsupported,
                "a:11: cell 1 is of type 22, with curved sides, which is not read");
    check_error(start + cells + "CELL_TYPES 1\n5\n", Format::vtk, bad_index,
                "a:8: CELL_TYPES has no type for cell 1");
    check_error(start + cells, Format::vtk, bad_index, "a:8: CELL_TYPES has no type for cell 0");
    check_error(start + "CELLS 1 4\n3 0 1 4\n" + types, Format::vtk, bad_index,
                "a:8: cell 0 names point 4, but there are 4");
    check_error(start + "POLYGONS 1 4\n3 0 1 2\n", Format::vtk, bad_syntax,
                "a:8: \"polygons\" is no section of UNSTRUCTURED_GRID");
    const std::string named = start + "FIELD f 1\nsurface_name 1 2 string\nA\nB\n" + cells + types;
    const auto read = parse_surfaces(named, "a", Format::vtk);
    REQUIRE(read); // the file does not tell who has which triangle
    CHECK(read->front().triangles.size() == 2);
    const std::string array = "CELL_DATA 2\nSCALARS surface int\nLOOKUP_TABLE default\n";
    CHECK(parse_surfaces(named + array + "1 0\n", "a", Format::vtk)->size() == 2);
    check_error(named + array + "1 2\n", Format::vtk, bad_index,
                "a:12: polygon 1 is of surface 2, but there are 2");
    check_error(named + "CELL_DATA 1\nSCALARS surface int\nLOOKUP_TABLE default\n1\n", Format::vtk,
                bad_index, "a:12: the array surface has no value for polygon 1");
    check_error(named + "CELL_DATA 2\nSCALARS surface int\n1 1\n", Format::vtk, bad_syntax,
                "a:19: LOOKUP_TABLE is needed here");
    check_error(start + "FIELD f 1\nsurface_name 1 2 string\nA\n" + cells, Format::vtk, bad_syntax,
                "a:12: \"3\" is no section of UNSTRUCTURED_GRID"); // a text is missing
}

TEST_CASE("MSH: what can't be read is named with its line", "[io][msh]") {
    using enum ErrorCode;
    const std::string start = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    const std::string nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n7 0 1 0\n$EndNodes\n";
    REQUIRE(parse_surfaces(start + nodes + "$Elements\n1\n1 2 2 0 1 1 2 7\n$EndElements\n", "a",
                           Format::msh));
    check_error("", Format::msh, nothing_to_do, "a: the file is empty");
    check_error("x", Format::msh, bad_syntax, "a:1: the first line is not $MeshFormat");
    check_error("$MeshFormat\n4.0 0 8\n", Format::msh, unsupported,
                "a:2: MSH \"4.0\" is not read, only 2.2 and 4.1");
    check_error(start + nodes, Format::msh, nothing_to_do, "a: there is no triangle");
    check_error(start + "$Nodes\n9999\n", Format::msh, bad_syntax,
                "a:5: 9999 lines are more than the file has");
    check_error(start + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", Format::msh, bad_index,
                "a:7: there is a second node 1");
    check_error(start + "$Nodes\n1\n1 0 0 nan\n$EndNodes\n", Format::msh, bad_number,
                "a:6: \"nan\" is not a finite number");
    check_error(start + nodes + "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n", Format::msh,
                bad_index, "a:12: the element names node 3, which does not exist");
    check_error(start + nodes + "$Elements\n1\n1 9 2 0 1 1 2 7 1 2 7\n$EndElements\n", Format::msh,
                unsupported,
                "a:12: elements of type 9 have curved sides; only triangles and quadrilaterals of "
                "the first order are read");
    check_error(start + nodes + "$Elements\n2\n1 2 2 0 1 1 2 7\n$EndElements\n", Format::msh,
                bad_syntax, "a:13: the end of the line is not an integer");
    check_error(start + "$Nodes\n0\n$EndElements\n", Format::msh, bad_syntax,
                "a:6: expected $EndNodes, found \"$EndElements\"");
}

TEST_CASE("tetrahedra and their labels are read from VTU, legacy VTK and MSH",
          "[io][vtu][vtk][msh]") {
    const std::string points = "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1";
    const std::string vtu =
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"5\"><Points>"
        "<DataArray type=\"Float64\" format=\"ascii\" NumberOfComponents=\"3\">" +
        points +
        "</DataArray></Points><Cells><DataArray Name=\"connectivity\" format=\"ascii\">"
        "0 1 2 3 0 1 2 1 2 3 4</DataArray><DataArray Name=\"offsets\" format=\"ascii\">4 7 11"
        "</DataArray><DataArray Name=\"types\" format=\"ascii\">10 5 "
        "10</DataArray></Cells><CellData>"
        "<DataArray Name=\"ARRAY\" format=\"ascii\">7 -1 9</DataArray></CellData></Piece>"
        "</UnstructuredGrid></VTKFile>";
    const std::string vtk =
        "# vtk DataFile Version 2.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n" +
        points +
        "\nCELLS 3 14\n4 0 1 2 3\n3 0 1 2\n4 1 2 3 4\nCELL_TYPES 3\n10 5 10\nCELL_DATA 3\n"
        "SCALARS ARRAY int 1\nLOOKUP_TABLE default\n7 -1 9\n";
    const std::string nodes = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n";
    const std::string msh =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n" + nodes +
        "$EndNodes\n$Elements\n3\n1 4 2 7 1 1 2 3 4\n2 2 2 3 1 1 2 3\n3 4 2 0 9 2 3 4 5\n"
        "$EndElements\n";
    const std::string msh4 =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 2\n1 0 0 0 1 1 0 1 3 0\n"
        "1 0 0 0 1 1 1 1 7 0\n9 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n"
        "4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n$Elements\n3 3 1 3\n3 1 4 1\n1 1 2 3 "
        "4\n"
        "2 1 2 1\n2 1 2 3\n3 9 4 1\n3 2 3 4 5\n$EndElements\n";
    const auto with = [](std::string text, const std::string& array) {
        return text.replace(text.find("ARRAY"), 5, array);
    };
    const TemporaryFolder folder;
    const auto read = [&](const std::string& name, const std::string& text) {
        REQUIRE(write_file(folder.path() / name, text));
        return read_tetrahedra(folder.path() / name);
    };
    for (const auto& [name, text] :
         {std::pair<std::string, std::string>{"a.vtu", with(vtu, "block")},
          {"b.vtu", with(vtu, "CellEntityIds")},
          {"a.vtk", with(vtk, "cell_scalars")},
          {"a.msh", msh},
          {"b.msh", msh4}}) {
        INFO(name);
        const auto found = read(name, text);
        INFO((found ? std::string() : found.error().message()));
        REQUIRE(found);
        CHECK(found->tetrahedra ==
              std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}});
        CHECK(found->labels == std::vector<std::uint32_t>{7, 9});
        CHECK(found->vertices.size() == 5);
        CHECK(found->vertices[4] == Point3{1, 1, 1});
    }
    CHECK(read("c.vtu", with(vtu, "other"))->labels.empty());
    CHECK(read("c.vtk", with(vtk, "other"))->labels.empty());
    auto wrong = with(vtu, "block");
    wrong.replace(wrong.find("7 -1 9"), 6, "-7 0 9");
    CHECK(read("d.vtu", wrong)
              .error()
              .message()
              .find("the label of cell 0 is no number of 32 bits") != std::string::npos);
    CHECK(read("d.msh", msh.substr(0, msh.find("1 4 2 7")) +
                            "1 2 2 3 1 1 2 3\n2 2 2 3 1 1 2 3\n3 2 2 3 1 1 2 3\n$EndElements\n")
              .error()
              .code == ErrorCode::nothing_to_do);
    CHECK(read("d.obj", "v 0 0 0\n").error().code == ErrorCode::nothing_to_do);
}
