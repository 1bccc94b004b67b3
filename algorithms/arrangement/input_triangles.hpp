// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/id.hpp>

namespace terrane {

/// The numbering of input triangles and input vertices through all surfaces.
struct InputTriangles {
    std::vector<std::uint32_t> first;        ///< per surface: its first triangle; then the total
    std::vector<std::uint32_t> first_vertex; ///< per surface: its first vertex; then the total
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {input triangle, the first with the
                                                          ///< same three points}, ascending

    /// Returns the surface of an input triangle.
    [[nodiscard]] SurfaceId surface_of(InputTriangleId triangle) const;
    /// Returns the first triangle with the same three points: itself if it is no duplicate.
    [[nodiscard]] InputTriangleId first_same(InputTriangleId triangle) const;
};

} // namespace terrane
