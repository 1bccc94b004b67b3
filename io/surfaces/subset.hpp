// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::detail {

/// Cuts parts out of one array of vertices. A part has the vertices that its triangles use, in
/// the order of the whole, and triangles that count in the part.
class Subset {
public:
    explicit Subset(std::span<const Point3> vertices);

    /// Renumbers `triangles` (indices of the whole, in range) and returns the part's vertices.
    /// Cost: O(t log t) where the part is small, O(vertices of the whole) where it is not.
    std::vector<Point3> cut(std::vector<Triangle>& triangles);

private:
    std::vector<std::uint32_t> used_by(const std::vector<Triangle>& triangles);

    std::span<const Point3> whole_;
    std::vector<std::uint32_t> in_part_; ///< per vertex of the whole: index in the part
};

} // namespace terrane::detail
