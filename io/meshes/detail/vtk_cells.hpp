// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Kinds of cells of VTK's unstructured grids, by their numbers (vtkCellType.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::detail {

/// The part that a cell of an unstructured grid has in a surface.
enum class CellKind { passed_over, polygon, pixel, strip, curved };

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
    default:
        return CellKind::passed_over; // points, lines, volumes
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

} // namespace terrane::detail
