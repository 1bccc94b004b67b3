// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Ends of surfaces that reach a little beyond another one. Private to sealing.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>

namespace terrane::sealing::detail {

struct Overshoot {
    std::uint32_t surface = 0;
    std::vector<std::uint32_t> triangles{}; ///< of the arrangement, ascending
    double length = 0;                      ///< of the free border around it
    double largest = 0;                     ///< distance from the curve; unit of the input
    Point3 place{};                         ///< the vertex with that distance
};

/// Regions (regions.hpp) between a free border and curves with other surfaces, no point of which is
/// farther than `distance` from these curves, where the surface goes on beyond the curve. They
/// dangle, so no volume changes without them; none is listed whose loss would leave the border of
/// another surface free. Distances: in floating point, at vertices and a grid between them.
/// Triangles of several surfaces are never part of one.
std::vector<Overshoot> find_overshoots(const Arrangement& arrangement, double distance);

} // namespace terrane::sealing::detail
