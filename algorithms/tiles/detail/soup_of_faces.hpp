// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/tiles/tile.hpp>

namespace terrane::tiles::detail {

/// Faces of a tile with points of their own numbers, which ascend with the names: what is the
/// lowest here is the lowest everywhere.
struct SoupOfFaces {
    std::vector<std::uint32_t> names; ///< per point: input vertex, ascending
    std::vector<Point3> points;       ///< per name
    std::vector<Triangle> triangles;  ///< per face
    std::vector<std::uint32_t> ids;   ///< per face: input triangle, ascending

    [[nodiscard]] std::uint32_t point_named(std::uint32_t name) const;
    [[nodiscard]] std::uint32_t face_with(std::uint32_t id) const;
};

/// Makes a soup of faces that ascend by number.
SoupOfFaces soup_of(std::span<const Face> faces);

} // namespace terrane::tiles::detail
