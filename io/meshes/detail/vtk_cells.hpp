// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Kinds of cells of VTK's unstructured grids, by their numbers (vtkCellType.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::detail {

/// What a cell of an unstructured grid is to a reader.
enum class CellKind { passed_over, polygon, pixel, strip, curved, tetrahedron };

/// Returns the kind of a cell by its number in VTK.
inline CellKind kind_of_cell(std::int64_t type) {
    switch (type) {
    case 5: // triangle
    case 7: // polygon
    case 9: // quadrilateral
        return CellKind::polygon;
    case 6:
        return CellKind::strip;
    case 8:
        return CellKind::pixel;
    case 22: // quadratic and others of higher order
    case 23:
    case 28:
    case 30:
    case 34:
    case 36:
    case 69:
    case 70:
    case 76:
    case 77:
        return CellKind::curved;
    case 10: // tetrahedron; of second order, the corners come first
    case 24:
        return CellKind::tetrahedron;
    default:
        return CellKind::passed_over; // points, lines, other volumes
    }
}

/// Returns the error for a file that has this many cells, but no triangle among them.
inline Error no_triangle_among(std::size_t other_cells, std::string_view source) {
    return {ErrorCode::nothing_to_do,
            other_cells == 0 ? "there is no triangle"
                             : fmt::format("there is no triangle, only {} other cells; ParaView's "
                                           "Extract Surface makes triangles of them",
                                           other_cells),
            std::string(source)};
}

/// Names of arrays with the block of each cell, the first of which is read: those of Terrane, TetGen, Gmsh and meshio.
inline constexpr std::array<std::string_view, 4> label_arrays{"block", "cell_scalars",
                                                              "CellEntityIds", "gmsh:physical"};

/// Appends a tetrahedron by its first four corners, if it has these.
inline void append_tetrahedron(std::span<const std::uint32_t> corners, LabelledTetrahedra& all) {
    if (corners.size() >= 4)
        all.tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
}

/// Appends the label of a cell. Returns false if it is no integer of 32 bits.
template <class Number>
bool append_label(Number value, LabelledTetrahedra& all) {
    if (!(value >= 0 && value <= Number(UINT32_MAX))) return false;
    all.labels.push_back(static_cast<std::uint32_t>(value));
    return Number(all.labels.back()) == value;
}

} // namespace terrane::detail
