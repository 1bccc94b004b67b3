// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra against the surfaces and blocks that they fill. Two methods that share no code meet
// here: regions by diffusion over the tetrahedra, blocks by shells and lines (volumes.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/tetrahedra_shape.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// A block as it is, and as tetrahedra fill it. Cubic unit.
struct RegionVolume {
    double block = 0; ///< nearest to the exact volume; [0]: negative, as the box is not counted
    double tetrahedra = 0; ///< nearest to their exact sum
    double difference = 0; ///< nearest to the exact one, tetrahedra - block
    double bound = 0;   ///< on the difference of the two, from vertices that were rounded next to
                        ///< triangles: the largest distance of one from its triangle times the
                        ///< area of all faces around the block, doubled
    bool equal = false; ///< exactly
};

struct TetrahedraReport {
    std::vector<std::string> violations; ///< a sentence each; empty: all is well
    std::vector<RegionVolume> volumes;   ///< per volume; [0], the outside, is not compared
    TetrahedraShape shape;               ///< judged by nobody
};

/// Finds
///   a tetrahedron that is inverted or has no volume;
///   a triangle that is not the union of faces: those that name it must be a disk whose border goes
///   through its three corners;
///   a region (by diffusion) that is not one block: the tetrahedra in front of and behind each face
///   must have the volumes of its triangle as region_of;
///   a block whose tetrahedra have another volume than it, beyond the bound.
/// `volumes` are those of the mesh. Cost: O(n log n); exact sums.
TetrahedraReport check_tetrahedra(const TetrahedralMesh& tetrahedra, const Mesh& mesh,
                                  const Volumes& volumes);

/// Gives the regions of the tetrahedra the numbers of the volumes of the mesh.
/// Errors: internal, with the place, where a region touches triangles of two volumes, or two
/// regions those of one; where a region that touches no triangle is not the outside.
Status adopt_volume_numbers(const Volumes& volumes, TetrahedralMesh& tetrahedra);

} // namespace terrane
