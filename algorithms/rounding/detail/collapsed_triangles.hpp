// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/mesh/triangle_table.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::rounding::detail {

using Side = std::array<std::uint32_t, 2>; ///< two vertices, ascending
struct SideHash {
    std::size_t operator()(const Side& s) const { return hash_of(Triangle{s[0], s[1], 0}); }
};

/// Returns the side from corner i to the next.
Side side_of(const Triangle& t, unsigned i);

/// Points inside each side of a triangle, in order from its corner i.
using PointsInSides = std::array<std::vector<std::uint32_t>, 3>;

/// Triangles that collapsed to lines. When they are dropped, their corners remain inside the sides
/// of their neighbours. Collapsed triangles that share a side lie on one line. Dividing the
/// neighbours' sides on that line at all corners on it makes these sides match again: statement (2)
/// of docs/explanation/rounding.md.
class CollapsedTriangles {
public:
    /// lost: indices of the collapsed triangles. Preconditions: points with the same coordinates
    /// have the same index, and the lost triangles have no area.
    CollapsedTriangles(std::span<const Point3> points, std::span<const Triangle> triangles,
                       std::span<const std::uint32_t> lost);

    /// Returns the points at which the sides of t must be divided. Cost: three look-ups if two
    /// corners of t are corners of lost triangles, else none.
    [[nodiscard]] PointsInSides within(const Triangle& t) const;
    /// Returns their number, for the same cost.
    [[nodiscard]] std::size_t count_within(const Triangle& t) const;

private:
    /// Returns the points inside a side, in lexicographic order.
    [[nodiscard]] std::span<const std::uint32_t> inside(std::uint32_t from, std::uint32_t to) const;
    [[nodiscard]] bool is_concerned(const Triangle& t, unsigned i) const {
        return is_corner_[t[i]] && is_corner_[t[(i + 1) % 3]];
    }

    std::span<const Point3> points_;
    std::vector<bool> is_corner_; ///< per point: whether a lost triangle has it
    std::unordered_map<Side, std::uint32_t, SideHash>
        line_of_; ///< per side of lost triangles with different ends
    std::vector<std::vector<std::uint32_t>> corners_on_; ///< per line, in lexicographic order
};

/// Divides t at points inside its sides and appends the parts to `out`.
void divide_at(const Triangle& t, const PointsInSides& within, std::vector<Triangle>& out);

} // namespace terrane::rounding::detail
