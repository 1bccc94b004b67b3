// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The volumes that surfaces enclose: blocks. No epsilon.
//
// A volume is a connected part of what is left of space without the triangles. Number 0 is the
// outside, the one without end; 1, 2, ... are the blocks. Steps:
//   (a) shells: sides of triangles, joined where they face each other round an edge (radial.hpp);
//   (b) nesting: shells on one volume, by exact lines (nesting.hpp);
//   (c) numbers: by the block's lexicographically least vertex; among blocks that share it by all
//       their vertices, ascending, in lexicographic order; then by their least triangle. So they
//       depend on the points alone, not on the order of files, surfaces, triangles or threads;
//   (d) measures.
// Cost: linear, but for sorting the vertices; predicates only at edges of more than two triangles.
// Source: the paper, section 3, last remark (regions one dimension up), without tetrahedra.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

struct Volumes {
    /// Per triangle: the volume in front (from where its corners appear counterclockwise) and the
    /// one behind. Equal where the triangle dangles: a fault tip, an open sheet.
    std::vector<std::array<std::uint32_t, 2>> of_sides;
    /// Per volume, cubic unit: the double nearest to the exact volume (ties to even; infinite
    /// beyond the largest double). [0]: of all that the outside does not fill. The exact ones add
    /// up: [1] + [2] + ... = [0]; see exact_volumes.
    std::vector<double> measures = std::vector<double>(1);
    double seconds_shells = 0, seconds_nesting = 0, seconds_measures = 0;

    /// Number of blocks; the outside is not counted.
    [[nodiscard]] std::size_t block_count() const { return measures.size() - 1; }
    [[nodiscard]] bool dangles(std::size_t triangle) const {
        return of_sides[triangle][0] == of_sides[triangle][1];
    }
};

/// Errors: interrupted, out_of_memory; internal where the arrangement is noticed to be none
/// (triangles overlap).
Result<Volumes> find_volumes(const Arrangement& arrangement, const Run& run = {});

/// The same for doubles that are conforming (see check.hpp, rounding.hpp).
/// Errors: as above; bad_index, bad_number.
Result<Volumes> find_volumes(const Mesh& mesh, const Run& run = {});

/// The exact measures, as reduced fractions in digits of a base (see fraction.hpp): "1", "125/6".
/// Cost: numbers have as many digits as all constructed corners together: 10 000 such corners take
/// seconds, 100 000 minutes.
std::vector<std::string> exact_volumes(const Arrangement& arrangement, const Volumes& volumes,
                                       int base = 10);
std::vector<std::string> exact_volumes(const Mesh& mesh, const Volumes& volumes, int base = 10);

/// Which block of the exact arrangement each block of its rounded mesh is: per volume of the mesh
/// its number among `exact`, or UINT32_MAX where rounding made it. [0] is 0. No number comes twice.
/// By the triangles that both have (with corners at the nearest doubles of the exact ones): the
/// pair of blocks with most of them first.
std::vector<std::uint32_t> match_volumes(const Arrangement& arrangement, const Volumes& exact,
                                         const Mesh& mesh, const Volumes& rounded);

/// The same volumes with the numbers of their matches, of which there are `exact`, the outside
/// counted; those without a match follow after. Numbers that are not taken become blocks without
/// triangles, of measure 0: too thin for doubles.
Volumes renumbered(const Volumes& volumes, std::span<const std::uint32_t> match, std::size_t exact);

} // namespace terrane
