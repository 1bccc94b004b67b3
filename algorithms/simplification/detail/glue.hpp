// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Glues a complex together where it is nearer to itself than the resolution.
//
// Pass by pass, contacts are found, and the nearest ones first become one vertex each: places on
// edges and in cells become vertices, and both go to the one of them that has less freedom (a
// corner, then a curve), or to the middle. Triangles longer than twice the resolution are divided
// first where surfaces are near, so that the glued part ends where the gap opens. A contact is left
// alone where a vertex would move too far or leave the boundary of a volume of interest, where
// a triangle would turn over, and at locked blocks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/simplification/detail/complex.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>

namespace terrane::simplification::detail {

struct GlueOptions {
    double resolution = 0;
    double max_move = 0;                                    ///< of a vertex, all moves together
    std::span<const std::array<std::uint32_t, 2>> sides_of; ///< per origin: its blocks
    std::vector<bool> locked;                               ///< per block: nothing of it is glued
};

struct GlueReport {
    std::size_t corners = 0; ///< pairs of corners that were joined
    std::size_t curves = 0;  ///< places of curves
    std::size_t sheets = 0;  ///< places of surfaces
    std::size_t divided = 0; ///< edges
    bool is_complete = true; ///< the passes sufficed
    std::vector<LeftAlone> left{};
};

/// Glues the complex. Ends early if a stop is requested.
GlueReport glue(Complex& complex, const GlueOptions& options, const Run& run);

} // namespace terrane::simplification::detail
