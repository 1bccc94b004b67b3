// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// Corner indices into an array of vertices that stands beside it.
using Triangle = std::array<std::uint32_t, 3>;

/// What a surface is to the geologist. Never changes the geometry.
enum class Role : std::uint8_t { unknown, horizon, fault, boundary };

/// A triangulated surface as it comes: open, crossing itself, duplicated, degenerate: anything
/// finite.
struct Surface {
    std::string name; ///< as in the file; need not be unique
    Role role = Role::unknown;
    std::vector<Point3> vertices;    ///< order and unit of the file; finite
    std::vector<Triangle> triangles; ///< order of the file; indices < vertices.size()
};

} // namespace terrane
