// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

struct SharpAngle {
    double degrees = 0; ///< between two triangles at an edge, from 0 to 180
    Point3 place{};     ///< the middle of the edge
};

/// The smallest angle between triangles that share an edge, in floating point; nothing where none
/// do. Where makers of tetrahedra fail, it is where they are most likely to. Cost: linear.
std::optional<SharpAngle> sharpest_angle(const Mesh& mesh);

} // namespace terrane
