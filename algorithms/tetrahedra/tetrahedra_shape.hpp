// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How well shaped tetrahedra are, as finite element and volume methods care about it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Of a number of values; all 0 where there are none.
struct ShapeSpread {
    double least = 0, mean = 0, largest = 0;
};

/// Upper ends of the classes of radius-edge ratios, the last class being open: [0, 0.75),
/// [0.75, 1), ... [100, infinity). The regular tetrahedron has sqrt(6) / 4 = 0.612, the least.
inline constexpr std::array<double, 11> radius_edge_bounds{0.75, 1,  1.25, 1.5, 2,  3,
                                                           5,    10, 20,   50,  100};
inline constexpr std::size_t dihedral_bins = 18; ///< of 10 degrees each; 180 counts to the last

struct TetrahedraShape {
    ShapeSpread dihedral; ///< degrees, six per tetrahedron
    std::array<std::size_t, dihedral_bins> dihedral_histogram{};
    ShapeSpread
        radius_edge; ///< circumradius to shortest edge; infinite where a tetrahedron is flat
    std::array<std::size_t, radius_edge_bounds.size() + 1> radius_edge_histogram{};
};

/// Angle between the two faces on each edge, degrees in [0, 180]:
/// edges 01, 02, 03, 12, 13, 23.
std::array<double, 6> dihedral_angles(const std::array<Point3, 4>& corners);

double radius_edge_ratio(const std::array<Point3, 4>& corners);

/// Of all tetrahedra, those of the outside too. In doubles: for information, no decision.
TetrahedraShape shape_of(const TetrahedralMesh& mesh);

} // namespace terrane
