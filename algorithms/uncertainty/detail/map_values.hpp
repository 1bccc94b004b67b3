// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The heights of a surface as a function of the map.
#pragma once

#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>

namespace terrane::uncertainty::detail {

/// Interpolates z linearly in the triangles, and takes the nearest place of them elsewhere.
class MapValues {
public:
    /// Precondition: the surface has a triangle.
    explicit MapValues(const Surface& map);
    MapValues(const MapValues&) = delete;
    MapValues& operator=(const MapValues&) = delete;

    [[nodiscard]] double at(double x, double y) const;

private:
    const Surface& map_;
    std::vector<Point3> flat_; ///< its vertices with z = 0
    TriangleTree tree_;        ///< of these
};

} // namespace terrane::uncertainty::detail
