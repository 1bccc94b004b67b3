// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The reader of tetrahedra_files.hpp for VTU.
#include <string>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra_files.hpp>
#include <terrane/algorithms/verify/detail/vtk_scanner.hpp>

namespace terrane::verifier {

namespace {

using Cells = std::vector<std::int32_t>; ///< of tetrahedra, then of faces

/// Appends the values of faces to as many times `first` as there are tetrahedra.
Cells behind(const TetrahedraClaim& claim, std::int32_t first, const Cells& of_faces) {
    Cells cells(claim.tetrahedra.size(), first);
    cells.insert(cells.end(), of_faces.begin(), of_faces.end());
    return cells;
}

Cells block_cells(const TetrahedraClaim& claim) {
    Cells cells(claim.block_of.begin(), claim.block_of.end());
    cells.resize(claim.tetrahedra.size() + claim.faces.size(), -1);
    return cells;
}

Cells parent_cells(const TetrahedraClaim& claim) {
    Cells parents;
    for (const std::uint32_t t : claim.triangle_of)
        parents.push_back(t == no_number ? -1 : static_cast<std::int32_t>(t));
    return behind(claim, -1, parents);
}

/// Returns the cell of the other face of each pair of twins; -1 for all other cells.
Cells twin_cells(const TetrahedraClaim& claim) {
    const auto count = claim.tetrahedra.size();
    Cells twin(count + claim.faces.size(), -1);
    for (const auto& [front, back] : claim.twins) {
        twin[count + front] = static_cast<std::int32_t>(count + back);
        twin[count + back] = static_cast<std::int32_t>(count + front);
    }
    return twin;
}

void read_cell_data(VtkScanner& in, const ExpectedTetrahedra& expected) {
    const TetrahedraClaim& claim = expected.claim;
    in.expect("<CellData Scalars=\"block\">");
    in.array("block", block_cells(claim));
    in.array("surface", behind(claim, -1, first_of(expected.surfaces_of)));
    in.array("surface_count", behind(claim, 0, counts_of(expected.surfaces_of)));
    in.array("parent", parent_cells(claim));
    if (!claim.twins.empty()) {
        in.array("twin", twin_cells(claim));
        in.array("cut_side", behind(claim, 0, cut_sides(claim)));
    }
    in.expect("</CellData>");
}

void read_cells(VtkScanner& in, const TetrahedraClaim& claim) {
    constexpr std::uint8_t triangle = 5, tetrahedron = 10;
    std::vector<std::int64_t> corners, ends;
    std::vector<std::uint8_t> types;
    const auto add = [&](const auto& cells, std::uint8_t type) {
        for (const auto& cell : cells) {
            corners.insert(corners.end(), cell.begin(), cell.end());
            ends.push_back(static_cast<std::int64_t>(corners.size()));
            types.push_back(type);
        }
    };
    add(claim.tetrahedra, tetrahedron);
    add(claim.faces, triangle);
    in.expect("<Cells>");
    in.array("connectivity", corners);
    in.array("offsets", ends);
    in.array("types", types);
    in.expect("</Cells>");
}

} // namespace

std::vector<std::int32_t> cut_sides(const TetrahedraClaim& claim) {
    std::vector<std::int32_t> sides(claim.faces.size());
    for (const auto& [front, back] : claim.twins) {
        sides[front] = 1;
        sides[back] = 2;
    }
    return sides;
}

void compare_vtu(std::string_view contents, const ExpectedTetrahedra& expected) {
    const TetrahedraClaim& claim = expected.claim;
    VtkScanner in(contents);
    in.begin("UnstructuredGrid");
    in.field_data(expected.surfaces, expected.surfaces_of);
    in.expect("<Piece NumberOfPoints=\"" + std::to_string(claim.vertices.size()) +
              "\" NumberOfCells=\"" + std::to_string(claim.tetrahedra.size() + claim.faces.size()) +
              "\">");
    read_cell_data(in, expected);
    in.points(claim.vertices);
    read_cells(in, claim);
    in.end("UnstructuredGrid");
}

} // namespace terrane::verifier
