// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures of the shape of tetrahedra that matter to finite element and finite volume methods.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

inline constexpr std::size_t quality_bins = 10; ///< of a tenth each; 1 is in the last

/// Why a tetrahedron is bad; the first one that applies.
enum class BadCause : std::uint8_t {
    input_angle,   ///< two of its faces are on surfaces, which meet there at a bad angle
    thin_triangle, ///< one of its faces is on a surface, and has a bad angle itself
    gap,           ///< all of its corners are on surfaces
    other,         ///< none of these
};
inline constexpr std::size_t bad_causes = 4;
/// Below this angle, in degrees, a tetrahedron is bad.
inline constexpr double bad_angle = 10;
/// A tetrahedron of a lower mean ratio is misshapen. Source: Verdict's range of acceptable shapes.
inline constexpr double misshapen_ratio = 0.3;

/// The bad tetrahedra of one cause.
struct BadTetrahedra {
    std::size_t count = 0;
    double least = 0; ///< least dihedral angle, degrees
    Point3 place{};   ///< centre of the tetrahedron that has it
};

/// The shapes of all tetrahedra of a mesh.
struct TetrahedraShape {
    std::size_t count = 0;                                       ///< of tetrahedra
    ShapeSpread dihedral;                                        ///< degrees, six per tetrahedron
    std::array<std::size_t, dihedral_bins> dihedral_histogram{}; ///< number of angles by class
    ShapeSpread radius_edge; ///< circumradius over shortest edge; infinite for a flat tetrahedron
    std::array<std::size_t, radius_edge_bounds.size() + 1>
        radius_edge_histogram{}; ///< tetrahedra by class
    ShapeSpread sicn;            ///< signed inverse condition number, as in Gmsh; 1: regular
    std::array<std::size_t, quality_bins> sicn_histogram{};
    ShapeSpread mean_ratio; ///< "shape" in Verdict; 1: regular
    std::array<std::size_t, quality_bins> mean_ratio_histogram{};
    std::array<BadTetrahedra, bad_causes> bad{}; ///< by BadCause
};

/// Returns the angle between the two faces at each edge, in degrees in [0, 180], for the edges 01,
/// 02, 03, 12, 13, 23.
std::array<double, 6> dihedral_angles(const std::array<Point3, 4>& corners);

/// Returns the ratio of circumradius to shortest edge; infinite for a flat tetrahedron.
double radius_edge_ratio(const std::array<Point3, 4>& corners);

/// Returns 3 / (|J| |inverse of J|) for the map J from the regular tetrahedron, with the norms of
/// Frobenius: 1 for the regular tetrahedron, 0 for a flat one. Precondition: it is not inverted.
/// Source: Gmsh, SICN.
double inverse_condition(const std::array<Point3, 4>& corners);

/// Returns 12 (3 V)^(2/3) / (sum of the squared edges) for the volume V: 1 for the regular
/// tetrahedron, 0 for a flat one. Source: Liu and Joe 1994; Verdict, "shape".
double mean_ratio(const std::array<Point3, 4>& corners);

/// Measures all tetrahedra. The values are computed in doubles and decide nothing. A face is on a
/// surface if it is one of `mesh.faces`.
TetrahedraShape shape_of(const TetrahedralMesh& mesh);

} // namespace terrane
