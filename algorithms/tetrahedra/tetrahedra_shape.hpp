// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures of the shape of tetrahedra that matter to finite element and finite volume methods.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// The spread of some values; all 0 if there are none.
struct ShapeSpread {
    double least = 0;   ///< the least value
    double mean = 0;    ///< the arithmetic mean
    double largest = 0; ///< the largest value
};

/// The upper ends of the classes of radius-edge ratios; the last class is open: [0, 0.75),
/// [0.75, 1), ... [100, infinity). The least ratio is that of the regular tetrahedron,
/// sqrt(6) / 4 = 0.612.
inline constexpr std::array<double, 11> radius_edge_bounds{0.75, 1,  1.25, 1.5, 2,  3,
                                                           5,    10, 20,   50,  100};
inline constexpr std::size_t dihedral_bins = 18; ///< of 10 degrees each; 180 is in the last

/// The shapes of all tetrahedra of a mesh.
struct TetrahedraShape {
    ShapeSpread dihedral;                                        ///< degrees, six per tetrahedron
    std::array<std::size_t, dihedral_bins> dihedral_histogram{}; ///< number of angles by class
    ShapeSpread radius_edge; ///< circumradius over shortest edge; infinite for a flat tetrahedron
    std::array<std::size_t, radius_edge_bounds.size() + 1>
        radius_edge_histogram{}; ///< tetrahedra by class
};

/// Returns the angle between the two faces at each edge, in degrees in [0, 180], for the edges 01,
/// 02, 03, 12, 13, 23.
std::array<double, 6> dihedral_angles(const std::array<Point3, 4>& corners);

/// Returns the ratio of circumradius to shortest edge; infinite for a flat tetrahedron.
double radius_edge_ratio(const std::array<Point3, 4>& corners);

/// Measures all tetrahedra, including those of the outside. The values are computed in doubles and
/// decide nothing.
TetrahedraShape shape_of(const TetrahedralMesh& mesh);

} // namespace terrane
