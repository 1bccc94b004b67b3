// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Maps of a surface before and after its holes are filled, seen along z.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane::cli {

/// The data that one row of maps shows.
struct FillMap {
    std::string title;
    const Surface* before = nullptr;
    const Surface* after = nullptr;    ///< `before`, then more vertices and triangles
    std::span<const double> deviation; ///< expected error of each vertex of `after`
    std::span<const BorderLoop> loops;
};

/// Draws an SVG with a row for each surface: heights before, heights after, and the expected error
/// of the filling, each with its own colour scale. Outer borders are black, holes red, gaps blue.
/// Each map has at most 200 x 200 cells.
std::string svg_of(std::span<const FillMap> maps);

} // namespace terrane::cli
