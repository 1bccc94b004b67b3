// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

using Side = std::array<std::uint32_t, 2>; ///< two vertices, ascending

/// From corner i to the next.
Side side_of(const Triangle& t, unsigned i);

/// Points inside each side of a triangle, in order from its corner i.
using PointsInSides = std::array<std::vector<std::uint32_t>, 3>;

/// Triangles that became lines and are dropped leave corners inside the sides of their neighbours.
/// Lost triangles that share a side lie on one line; the neighbours' sides on it are divided at all
/// their corners. Then these sides fit again: statement (2) of docs/explanation/rounding.md.
class CollapsedTriangles {
public:
    /// Precondition: points with the same coordinates have the same index; the lost triangles are
    /// without area.
    CollapsedTriangles(std::span<const Point3> points, std::span<const Triangle> triangles,
                       std::span<const std::uint32_t> lost);

    /// Cost: three look-ups if two corners of t are corners of lost triangles, else nothing.
    [[nodiscard]] PointsInSides within(const Triangle& t) const;

private:
    [[nodiscard]] std::vector<std::uint32_t> within(std::uint32_t from, std::uint32_t to) const;

    std::span<const Point3> points_;
    std::vector<bool> is_corner_;           ///< per point: of a lost triangle
    std::map<Side, std::uint32_t> line_of_; ///< of lost triangles; not of two equal corners
    std::vector<std::vector<std::uint32_t>> corners_on_; ///< per line, in lexicographic order
};

/// Appends t, divided at points inside its sides.
void divide_at(const Triangle& t, const PointsInSides& within, std::vector<Triangle>& out);

} // namespace terrane
