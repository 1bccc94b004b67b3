// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The faces between columns of a corner-point grid, cut into strips.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/io/grids/corner_point.hpp>

namespace terrane::grids::detail {

/// A column of cells.
struct Column {
    std::uint32_t i = 0, j = 0;
};

/// The face between two columns, of which one may be outside the grid. The columns have the pillars
/// p and q in common; `corner_p` and `corner_q` tell which of the four pillars of each column these
/// are: a + 2b for pillar (i + a, j + b).
struct Wall {
    std::array<std::optional<Column>, 2> columns;
    std::array<unsigned, 2> corner_p{}, corner_q{};
    std::size_t p = 0, q = 0; ///< numbers of the pillars
};

enum class StripKind { none, fault, side };

/// The top or the base of an active cell at a wall.
struct CellEdge {
    double p = 0, q = 0; ///< its depths on both pillars
    std::uint32_t k = 0; ///< layer of the cell
    bool base = false;
    unsigned side = 0; ///< which of the two columns has the cell
};

/// The edges of cells on both sides of a wall, and lines from top to base that cut the wall wherever
/// edges of one side cross those of the other. Line 0 is pillar p, and the last one is pillar q.
struct WallEdges {
    std::vector<CellEdge>
        edges; ///< of the first column, then of the second; empty: no fault, no side
    std::vector<double>
        shares; ///< of each line: which share of an edge lies before it, from 0 to 1
    /// Per line: the depth of each edge; edges that cross there have the same one
    std::vector<std::vector<double>> depths;
};

/// A part of a wall between two lines and two chords.
struct Strip {
    StripKind kind = StripKind::none;
    std::array<double, 2> p{}, q{}; ///< depths of the upper and the lower chord on both lines
};

/// Looks up cells of a grid.
class Cells {
public:
    explicit Cells(const CornerPointGrid& grid) : grid_(grid) {}

    [[nodiscard]] bool active(Column c, std::uint32_t k) const {
        return grid_.active.empty() ||
               grid_.active[(std::size_t{k} * grid_.ny + c.j) * grid_.nx + c.i] != 0;
    }
    /// Returns the depth of a corner: on pillar a + 2b of the column, at the top or the base.
    [[nodiscard]] double depth(Column c, std::uint32_t k, unsigned corner, bool base) const {
        const std::size_t level = 2 * std::size_t{k} + (base ? 1 : 0);
        const std::size_t row = 2 * std::size_t{c.j} + corner / 2;
        return grid_.depths[(level * 2 * grid_.ny + row) * 2 * grid_.nx + 2 * std::size_t{c.i} +
                            corner % 2];
    }
    [[nodiscard]] std::array<double, 4> face(Column c, std::uint32_t k, bool base) const {
        return {depth(c, k, 0, base), depth(c, k, 1, base), depth(c, k, 2, base),
                depth(c, k, 3, base)};
    }
    [[nodiscard]] std::size_t pillar(Column c, unsigned corner) const {
        return (std::size_t{c.j} + corner / 2) * (std::size_t{grid_.nx} + 1) + c.i + corner % 2;
    }

private:
    const CornerPointGrid& grid_;
};

/// Returns all walls: those across i, row by row, then those across j. Wall w of a grid is the one
/// in place w.
std::size_t wall_count(const CornerPointGrid& grid);
Wall wall_at(const CornerPointGrid& grid, std::size_t w);
/// Returns the number of the wall with a named face.
std::size_t wall_of(const CornerPointGrid& grid, const NamedFace& face);

/// Returns the edges on a wall, and its lines. Where edges would cross at more than 1024 lines, or
/// columns have thousands of layers, only the pillars are lines.
WallEdges edges_on(const CornerPointGrid& grid, const Wall& wall);

/// Cuts the part of a wall between lines n and n + 1 into strips by chords from line to line, and
/// returns those that are parts of faults or sides, from above. The i-th chord joins the i-th edge
/// on one line with the i-th on the other, counted downward, which is the same edge unless edges
/// cross. A strip is a part of a fault if it is so at one end at least.
std::vector<Strip> strips_of(const CornerPointGrid& grid, const Wall& wall, const WallEdges& edges,
                             std::size_t n);

/// Returns the depths of all corners of active cells on a pillar, each once, in order.
std::vector<double> depths_on_pillar(const CornerPointGrid& grid, std::size_t pillar);

} // namespace terrane::grids::detail
