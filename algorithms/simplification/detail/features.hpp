// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Curves and corners of a complex.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/simplification/detail/complex.hpp>

namespace terrane::simplification::detail {

/// Curve edges have other than two cells, or two of different surfaces, or two that turn by more
/// than the crease angle. Corners are vertices at which other than two of them meet.
struct CurveNetwork {
    enum class Kind : std::uint8_t { corner, curve, inner };

    std::vector<Edge> edges;                            ///< sorted
    std::vector<Kind> kind_of;                          ///< per vertex
    std::vector<std::vector<std::uint32_t>> neighbours; ///< per vertex: along curve edges

    [[nodiscard]] bool has(std::uint32_t a, std::uint32_t b) const;
};

/// Finds the curves. Cost: linear, apart from sorting.
CurveNetwork find_curves(const Complex& complex);

} // namespace terrane::simplification::detail
