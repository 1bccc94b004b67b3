// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Pictures of a surface before and after its holes are filled, seen along z.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane::cli {

/// What a map shows of one surface.
struct FillMap {
    std::string title;
    const Surface* before = nullptr;
    const Surface* after = nullptr;    ///< the same and then more vertices and triangles
    std::span<const double> deviation; ///< per vertex of `after`
    std::span<const BorderLoop> loops;
};

/// An SVG with a row for each surface: heights before, heights after, and the expected error of
/// what was invented, each with its scale of colours. Outer borders are black, holes red, gaps
/// blue. Heights are sampled on 200 x 200 places per picture at most.
std::string svg_of(std::span<const FillMap> maps);

} // namespace terrane::cli
