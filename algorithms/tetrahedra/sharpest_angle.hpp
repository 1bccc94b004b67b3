// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

struct SharpAngle {
    double degrees = 0; ///< between two triangles at an edge, from 0 to 180
    Point3 place{};     ///< the middle of the edge
};

/// Returns the smallest angle between triangles that share an edge, in floating point; none if no
/// two triangles do. This is where tetrahedral meshing is most likely to fail. Cost: linear.
std::optional<SharpAngle> sharpest_angle(const Mesh& mesh);

struct ShortEdge {
    double length = 0; ///< unit of the mesh; infinite if there is no triangle
    Point3 place{};    ///< the middle of the edge
};

/// Returns the shortest edge of the triangles, in floating point. Cost: linear.
ShortEdge shortest_edge(const Mesh& mesh);

} // namespace terrane
