// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Moves some vertices of the input to a grid, so that nearly coplanar triangles become coplanar or
// clearly apart, or all to the decimals that they stand for, and the input can be arranged again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/rounding/detail/decimal_frame.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane::rounding::detail {

/// A grid with one spacing per axis, a power of two. Its nodes up to 2^53 spacings from the origin
/// are doubles. Planes across the axes are part of it.
struct SnapGrid {
    std::array<double, 3> step{};                  ///< 0: the axis is not snapped
    std::array<std::span<const double>, 3> kept{}; ///< see KeptPlanes

    /// Returns the node nearest to a point. A point on a plane stays on it, and others on their
    /// side of it.
    [[nodiscard]] Point3 snap(const Point3& p) const {
        return {snap(p.x, 0), snap(p.y, 1), snap(p.z, 2)};
    }
    /// Bounds the distance between a point and its node.
    [[nodiscard]] double reach() const;

private:
    [[nodiscard]] double snap(double x, unsigned axis) const;
};

/// Returns the grid whose spacing on each axis is 2^digits units in the last place of the largest
/// coordinate on that axis; or the coarsest finer one that moves no point by more than `limit`.
/// Returns nothing if there is none. `elsewhere`: the largest absolute coordinate of other points.
std::optional<SnapGrid> grid_of_digits(std::span<const Point3> points, int digits, double limit,
                                       const KeptPlanes& kept,
                                       const std::array<double, 3>& elsewhere = {});

/// The cells of chosen points in a grid, which is copied.
class SnapCells {
public:
    SnapCells(const SnapGrid& grid, std::span<const Point3> chosen);
    /// Returns the node of a point in one of the cells, and any other point as it is.
    [[nodiscard]] Point3 moved(const Point3& p) const;

private:
    SnapGrid grid_;
    std::unordered_set<Point3, PointHash> nodes_;
};

/// Returns an upper bound of the distance between two points.
double move_bound(const Point3& from, const Point3& to);

/// How the input of an arrangement differs from the surfaces that are rounded.
struct MovedInput {
    double largest = 0;                ///< no point of a surface is farther from where it was
    const InputFrame* frame = nullptr; ///< the arrangement is in this frame; null: in none
    std::size_t moved = 0;             ///< number of vertices that moved
    std::size_t merged = 0;            ///< by how many points distinct vertices became fewer
    /// Per place in the arrangement: the largest distance of a vertex there from where it was; 0
    /// for places that are missing.
    std::unordered_map<Point3, double, PointHash> moves{};

    [[nodiscard]] double move_of(const Point3& place) const {
        if (moves.empty()) return 0;
        const auto at = moves.find(place);
        return at == moves.end() ? 0 : at->second;
    }
};

/// The input of an arrangement with chosen vertices moved to a grid, or all in a frame.
class SnappedInput {
public:
    explicit SnappedInput(const Arrangement& a);

    /// Chooses the corners of input triangles. Returns false if all of them had been chosen before.
    bool choose(std::span<const std::uint32_t> triangles);

    /// Returns the surfaces with the chosen vertices, and all vertices in their cells, moved to the
    /// grid.
    std::vector<Surface> surfaces(const SnapGrid& grid);
    /// Returns the surfaces in a frame.
    std::vector<Surface> surfaces(const InputFrame& frame);

    /// Returns whether each vertex was chosen.
    [[nodiscard]] const std::vector<bool>& chosen() const { return chosen_; }
    /// Tells how the last call of surfaces() moved the input.
    [[nodiscard]] const MovedInput& how() const { return how_; }

private:
    std::vector<Surface> surfaces_at(std::span<const Point3> places);
    [[nodiscard]] Triangle corners_of(std::uint32_t t) const;
    Triangle own_corners(std::size_t s, Triangle corners, std::vector<Surface>& surfaces) const;

    const Arrangement& arrangement_;
    std::vector<bool> chosen_; ///< per input vertex
    MovedInput how_;
};

} // namespace terrane::rounding::detail
