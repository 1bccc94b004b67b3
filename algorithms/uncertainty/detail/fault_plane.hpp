// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The plane that a surface has in the mean.
#pragma once

#include <cstdint>
#include <span>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::uncertainty::detail {

struct FaultPlane {
    Point3 centre{};        ///< of area
    Point3 normal{0, 0, 1}; ///< the axis of the triangles' normals, of length 1; points up, or to
                            ///< greater x, then y, where it is level
    Point3 strike{1, 0, 0}; ///< level, of length 1, in the plane; x where the plane is level

    FaultPlane() = default;
    /// Of these surfaces together. However their triangles are oriented, the plane is the same.
    FaultPlane(std::span<const Surface> all, std::span<const std::uint32_t> surfaces);

    /// Returns the move of the point at `p` from the centre when the plane makes `turns` turns about
    /// its strike.
    [[nodiscard]] Point3 turned(const Point3& p, double turns) const;
};

} // namespace terrane::uncertainty::detail
