// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks tetrahedra against the surfaces and blocks that they fill, by exact predicates. The check
// trusts nothing of the program that made them. docs/explanation/tetrahedra.md proves what follows
// from an empty list of violations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/tetrahedra_shape.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

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
