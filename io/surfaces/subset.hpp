// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::detail {

/// Extracts parts of a mesh. The vertices of a part are those that its triangles use, in their
/// original order; its triangles are indices into them.
class Subset {
public:
    explicit Subset(std::span<const Point3> vertices);

    /// Renumbers `triangles` (indices into the whole, in range) and returns the vertices of the
    /// part. Cost: O(t log t) for a small part, otherwise O(vertices of the whole).
    std::vector<Point3> cut(std::vector<Triangle>& triangles);

private:
    std::vector<std::uint32_t> used_by(const std::vector<Triangle>& triangles);

    std::span<const Point3> whole_;
    std::vector<std::uint32_t> in_part_; ///< per vertex of the whole: index in the part
};

} // namespace terrane::detail
