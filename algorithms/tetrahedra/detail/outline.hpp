// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <terrane/kernel/point.hpp>

namespace terrane::tetrahedra::detail {

/// Returns a corner at which a closed polygon meets itself in the projection along an axis, other
/// than in the common ends of consecutive sides; none if the polygon is simple. `corners` are
/// indices into points, in order; at least three. Exact. Cost: sorting, and a test for each two
/// sides that overlap in one coordinate.
std::optional<std::uint32_t> crossing_of(std::span<const std::uint32_t> corners,
                                         std::span<const Point3> points, Axis axis);

} // namespace terrane::tetrahedra::detail
