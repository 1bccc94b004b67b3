// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds ends of surfaces that extend a little beyond another surface.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/sealing/detail/seal_distances.hpp>

namespace terrane::sealing::detail {

struct Overshoot {
    SurfaceId surface{};
    std::vector<std::uint32_t> triangles{}; ///< of the arrangement, ascending
    double length = 0;                      ///< of the free border around it
    double largest = 0;                     ///< distance from the curve; unit of the input
    Point3 place{};                         ///< the vertex with that distance
};

/// Finds regions (regions.hpp) between a free border and curves with other surfaces, all points of
/// which are within the distances for these surfaces of the curves, where the surface continues beyond the curve. They
/// dangle, so removing them changes no volume; regions whose removal would free the border of
/// another surface are omitted. Distances are in floating point, at vertices and a grid between
/// them. Triangles of several surfaces are never part of an overshoot.
std::vector<Overshoot> find_overshoots(const Arrangement& arrangement,
                                       const SealDistances& distances);

} // namespace terrane::sealing::detail
