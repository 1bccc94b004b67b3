// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The triangles of a surface on verticals.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane::cells {

/// Checks that no vertical meets several triangles of a surface that are not vertical. Errors: bad_option at its
/// name; those of arrange().
Status check_folds(const Surface& surface, const Run& run);

/// Finds the triangle of a surface on a vertical, in a lattice of squares in the map.
class BaseBelow {
public:
    explicit BaseBelow(const Surface& surface);

    /// Returns the triangle on the vertical through p, moved by an infinitely small way towards the middle of the
    /// triangle p, q, r in the map; or nothing where the surface is missing. Its corners are counterclockwise in the
    /// map.
    [[nodiscard]] std::optional<std::array<Point3, 3>> at(const Point3& p, const Point3& q,
                                                          const Point3& r) const;

private:
    [[nodiscard]] std::array<std::size_t, 2> square(double x, double y) const;

    std::vector<std::array<Point3, 3>>
        triangles_; ///< that are not vertical, counterclockwise in the map
    Point3 low_, high_;
    std::size_t side_ = 1;                            ///< squares along an axis
    std::vector<std::vector<std::uint32_t>> squares_; ///< triangles whose boxes reach into them
};

/// Returns the double nearest to the height of a triangle's plane on the vertical through p. The triangle is not
/// vertical.
double height_on(const std::array<Point3, 3>& triangle, const Point3& p);

} // namespace terrane::cells
