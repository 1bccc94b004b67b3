// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks tetrahedra against the surfaces and blocks that they fill. It compares two methods that
// share no code: regions by diffusion over the tetrahedra, and blocks by shells and lines
// (volumes.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/tetrahedra_shape.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// The volume of a block and that of its tetrahedra, in cubic units of the input.
struct RegionVolume {
    double block = 0; ///< nearest to the exact volume; [0]: negative, as the box is not counted
    double tetrahedra = 0; ///< nearest to the exact sum of their volumes
    double difference = 0; ///< nearest to the exact difference, tetrahedra - block
    double bound = 0;      ///< on the difference, which comes from vertices rounded off their
                           ///< triangles: twice the largest distance of a vertex from its triangle
                           ///< times the area of all faces around the block
    bool equal = false;    ///< whether the two volumes are exactly equal
};

/// The findings of check_tetrahedra().
struct TetrahedraReport {
    std::vector<std::string> violations; ///< one sentence each; empty: no violation
    std::vector<RegionVolume> volumes;   ///< per volume; [0], the outside, is not compared
    TetrahedraShape shape;               ///< reported only; never a violation
};

/// Reports
///   - tetrahedra that are inverted or have no volume;
///   - triangles that are not the union of faces: the faces that name a triangle must be a disk
///     whose border passes through the three corners of the triangle;
///   - regions (by diffusion) that are not exactly one block: region_of the tetrahedra in front of
///     and behind each face must be the volumes on the sides of its triangle;
///   - blocks whose volume differs from that of their tetrahedra by more than the bound.
/// `volumes` are those of the mesh. Cost: O(n log n); sums are exact.
TetrahedraReport check_tetrahedra(const TetrahedralMesh& tetrahedra, const Mesh& mesh,
                                  const Volumes& volumes);

/// Gives the regions of the tetrahedra the numbers of the volumes of the mesh.
/// Errors: internal, with the place, if a region touches triangles of two volumes, if two regions
/// touch triangles of one volume, or if a region that touches no triangle is not the outside.
Status adopt_volume_numbers(const Volumes& volumes, TetrahedralMesh& tetrahedra);

} // namespace terrane
