// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/grid.hpp>

#include <cmath>
#include <limits>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/maps/grid_frame.hpp>
#include <terrane/algorithms/mesh/validation.hpp>

namespace terrane {
namespace {

/// Builds the surface of a grid: vertices in the order of the nodes, triangles in that of the
/// cells.
class GridSurface {
public:
    GridSurface(const Grid& grid, bool depth) : grid_(grid), frame_(grid), depth_(depth) {}

    Result<Surface> make() {
        surface_.name = grid_.name;
        surface_.role = Role::horizon;
        if (const auto status = add_vertices(); !status) return status.error();
        mirrored_ = (grid_.dx < 0) != (grid_.dy < 0);
        for (std::size_t j = 0; j + 1 < grid_.ny; ++j)
            for (std::size_t i = 0; i + 1 < grid_.nx; ++i) add_cell(i, j);
        if (surface_.triangles.empty())
            return Error{ErrorCode::nothing_to_do,
                         "no cell of the grid has three corners with a height", ""};
        return std::move(surface_);
    }

private:
    Status add_vertices() {
        vertex_of_.assign(grid_.values.size(), no_index);
        for (std::size_t k = 0; k < grid_.values.size(); ++k) {
            const double value = grid_.values[k];
            if (std::isnan(value)) continue;
            const std::size_t column = k % grid_.nx, row = k / grid_.nx;
            const Point3 p = frame_.node(static_cast<double>(column), static_cast<double>(row),
                                         depth_ && value != 0 ? -value : value);
            if (!is_finite(p))
                return Error{ErrorCode::bad_number, "a node of the grid is beyond all doubles", ""};
            vertex_of_[k] = static_cast<std::uint32_t>(surface_.vertices.size());
            surface_.vertices.push_back(p);
        }
        return Done{};
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a == no_index || b == no_index || c == no_index) return;
        surface_.triangles.push_back(mirrored_ ? Triangle{a, c, b} : Triangle{a, b, c});
    }

    /// Adds the triangles of cell (i, j), whose corners are
    /// d c
    /// a b
    void add_cell(std::size_t i, std::size_t j) {
        const std::size_t k = j * grid_.nx + i;
        const auto a = vertex_of_[k], b = vertex_of_[k + 1], c = vertex_of_[k + grid_.nx + 1],
                   d = vertex_of_[k + grid_.nx];
        if (along_ac(a, b, c, d)) {
            add(a, b, c);
            add(a, c, d);
        } else {
            add(a, b, d);
            add(b, c, d);
        }
    }

    /// Tells whether the cell is divided along a c. A missing corner leaves only the diagonal
    /// between its neighbours.
    [[nodiscard]] bool along_ac(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                std::uint32_t d) const {
        if (a == no_index || c == no_index) return false;
        if (b == no_index || d == no_index) return true;
        const auto z = [&](std::uint32_t v) { return surface_.vertices[v].z; };
        return std::abs(z(a) - z(c)) <= std::abs(z(b) - z(d));
    }

    const Grid& grid_;
    GridFrame frame_;
    bool depth_;
    bool mirrored_ = false;
    std::vector<std::uint32_t> vertex_of_;
    Surface surface_;
};

} // namespace

Result<Surface> surface_of_grid(const Grid& grid, bool depth) {
    return guarded("for the grid", "grid", [&]() -> Result<Surface> {
        if (grid.values.size() != std::size_t{grid.nx} * grid.ny || grid.dx == 0 || grid.dy == 0)
            return Error{ErrorCode::bad_option, "the grid has no steps or not nx ny values", ""};
        auto surface = GridSurface(grid, depth).make();
        if (surface && depth) surface->frame.vertical_axis = VerticalAxis::down;
        return surface;
    });
}

double height_at(const Grid& grid, double x, double y) {
    const StandardArithmetic guard;
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    const auto [u, v, _] = GridFrame(grid).steps(x, y);
    if (!(u >= 0 && v >= 0 && u <= grid.nx - 1.0 && v <= grid.ny - 1.0)) return missing;
    if (grid.nx < 2 || grid.ny < 2) return missing;
    const double i = std::min(std::floor(u), grid.nx - 2.0);
    const double j = std::min(std::floor(v), grid.ny - 2.0);
    const auto k = static_cast<std::size_t>(j) * grid.nx + static_cast<std::size_t>(i);
    const double s = u - i, t = v - j;
    return (1 - t) * ((1 - s) * grid.values[k] + s * grid.values[k + 1]) +
           t * ((1 - s) * grid.values[k + grid.nx] + s * grid.values[k + grid.nx + 1]);
}

} // namespace terrane
