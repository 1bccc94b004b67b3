// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks tetrahedra against the surfaces and blocks that they fill, by exact predicates. The check
// trusts nothing of the program that made them. docs/explanation/tetrahedra.md proves what follows
// from an empty list of violations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

// Measures of the shape of tetrahedra that matter to finite element and finite volume methods.

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

/// The defects of tetrahedra, in the order in which they are reported. "Near" means within the
/// allowance, a few spacings of the doubles at the coordinates of the input triangle.
enum class TetrahedraDefect : std::uint8_t {
    unusable_lists, ///< an index, a length or a coordinate makes no sense; nothing else is checked
    wrong_attributes,   ///< surfaces of the mesh or of a face are not those of the input
    doubled_node,       ///< two nodes are at one point, and no cut is between them
    wrong_twins,        ///< twin faces do not match, or a cut is not where the twins are
    no_volume,          ///< a tetrahedron is flat or inverted
    open_face,          ///< a face with one tetrahedron is neither on a surface nor on the box
    crowded_face,       ///< a face has two tetrahedra on one side
    box_not_filled,     ///< the tetrahedra do not add up to the box, exactly
    missing_vertex,     ///< no node has exactly the coordinates of an input vertex
    stray_face,         ///< a face is listed twice, or is no face of a tetrahedron
    uncovered_triangle, ///< an input triangle has no faces
    broken_outline,     ///< the outline of its faces does not follow the sides of a triangle
    torn_edge,          ///< triangles at one edge divide it at different nodes
    node_off_edge,      ///< a node on an edge of a triangle is not near it
    node_off_plane,     ///< a node on a triangle is not near its plane
    folded_faces,       ///< faces of a triangle overlap in the projection
    wrong_block,        ///< a tetrahedron is not in the block that lies on its side of a surface
    wrong_volume,       ///< the volumes of a block and its tetrahedra differ by more than the bound
};

/// The name of a defect, as it is spelled above.
std::string_view name_of(TetrahedraDefect defect);

/// All defects of one kind.
struct TetrahedraViolation {
    TetrahedraDefect defect{}; ///< the kind of defect
    std::size_t count = 0;     ///< how many there are, >= 1
    std::string first;         ///< a sentence about the first one, with its place
};

/// The sentence about the first defect, and the number of the others.
std::string message(const TetrahedraViolation& violation);

/// The volume of a block and that of its tetrahedra, in cubic units of the input.
struct BlockVolume {
    double block = 0; ///< nearest to the exact volume; [0], the outside: that of its tetrahedra
    double tetrahedra = 0; ///< nearest to the exact sum of their volumes
    double difference = 0; ///< nearest to the exact difference, tetrahedra - block
    double bound = 0;      ///< on the difference: what nodes near the triangles of the block can
                           ///< make; 0 if none of these triangles is divided
    bool equal = false;    ///< whether the two volumes are exactly equal
};

/// The findings of check_tetrahedra().
struct TetrahedraReport {
    std::vector<TetrahedraViolation> violations; ///< one per kind that occurs, in their order
    std::vector<BlockVolume> volumes;            ///< per block
    TetrahedraShape shape;                       ///< of all tetrahedra; never a violation
};

/// Checks tetrahedra as tetrahedralize() makes them, and as without_outside() and split_nodes()
/// leave them. Without violations this holds (in brackets: the statements of tetrahedra.md):
///   - all tetrahedra have a positive volume; with the outside they tile the box, and any two of
///     them share a corner, an edge, a face, or nothing (2);
///   - each corner of a triangle is a node with exactly its coordinates;
///   - the faces that name a triangle cover it: their nodes are near the triangle, and their
///     projections along an axis tile it without overlap (3); all their points are within a reach
///     of the triangle that depends on its coordinates only (5); a triangle that is not divided is
///     its face;
///   - the tetrahedra of a block fill the block, except within reach of its divided triangles (6);
///     so no node farther away is on the wrong side of a surface (7);
///   - the volume of each block is that of its tetrahedra, within a bound that depends on its
///     triangles only (8);
///   - each face names the surfaces of its triangle.
/// The mesh must be conforming, and the volumes its own. Cost: O(n log n). Only nodes on divided
/// triangles and volumes need more than filtered predicates.
TetrahedraReport check_tetrahedra(const TetrahedralMesh& tetrahedra, const Mesh& mesh,
                                  const Volumes& volumes);

/// Gives the blocks of the tetrahedra the numbers of the volumes of the mesh.
/// Errors: internal, with the place, if a block touches triangles of two volumes, if two blocks
/// touch triangles of one volume, or if a block that touches no triangle is not the outside.
Status adopt_volume_numbers(const Volumes& volumes, TetrahedralMesh& tetrahedra);

} // namespace terrane
