// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Moves some vertices of the input to a grid, so that nearly coplanar triangles become coplanar and
// the input can be arranged again.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane::rounding::detail {

/// A grid with one spacing per axis, a power of two. Its nodes up to 2^53 spacings from the origin
/// are doubles.
struct SnapGrid {
    std::array<double, 3> step{}; ///< 0: the axis is not snapped

    /// Returns the node nearest to a point.
    [[nodiscard]] Point3 snap(const Point3& p) const {
        return {snap(p.x, step[0]), snap(p.y, step[1]), snap(p.z, step[2])};
    }

private:
    // Division and multiplication by a power of two are exact, so a node is its own nearest node.
    static double snap(double x, double s) { return s > 0 ? std::nearbyint(x / s) * s : x; }
};

/// Returns the grid whose spacing on each axis is 2^digits units in the last place of the largest
/// coordinate on that axis.
SnapGrid grid_of_digits(std::span<const Point3> points, int digits);

/// The input of an arrangement with chosen vertices moved to a grid.
class SnappedInput {
public:
    explicit SnappedInput(const Arrangement& a);

    /// Chooses the corners of all parents of the triangles in contact. Returns false if all of them
    /// had been chosen before.
    bool choose(const RoundedMesh& rounded);

    /// Returns the surfaces with the chosen vertices, and all vertices in their cells, moved to the
    /// grid.
    std::vector<Surface> surfaces(int digits);

    /// Returns the largest distance by which the last call of surfaces() moved a vertex, rounded
    /// up.
    [[nodiscard]] double largest_move() const { return largest_; }
    /// Returns the number of vertices that the last call of surfaces() moved.
    [[nodiscard]] std::size_t moved() const { return moved_; }
    /// Returns by how many distinct points the last call of surfaces() reduced the vertices.
    [[nodiscard]] std::size_t merged() const { return merged_; }

private:
    Point3 snapped(const Point3& p, const SnapGrid& grid,
                   const std::unordered_set<Point3, PointHash>& cells);
    [[nodiscard]] Triangle corners_of(std::uint32_t t) const;
    Triangle own_corners(std::size_t s, Triangle corners, std::vector<Surface>& surfaces) const;

    const Arrangement& arrangement_;
    std::vector<bool> chosen_; ///< per input vertex
    double largest_ = 0;
    std::size_t moved_ = 0, merged_ = 0;
};

} // namespace terrane::rounding::detail
