// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace terrane {

/// Which input triangles are which: numbers count through all surfaces.
struct InputTriangles {
    std::vector<std::uint32_t> first;                     ///< per surface, and the total at the end
    std::vector<std::uint32_t> first_vertex;              ///< the same for input vertices
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {input triangle, the first with the
                                                          ///< same three points}, ascending

    /// The surface that an input triangle is of.
    [[nodiscard]] std::uint32_t surface_of(std::uint32_t triangle) const;
    /// The first triangle with the same three points: itself where it is no duplicate.
    [[nodiscard]] std::uint32_t first_same(std::uint32_t triangle) const;
};

} // namespace terrane
