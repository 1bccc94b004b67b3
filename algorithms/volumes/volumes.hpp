// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The volumes that surfaces enclose, found exactly, without an epsilon.
//
// A volume is a connected part of the complement of the triangles. Number 0 is the outside, which
// is unbounded; 1, 2, ... are the blocks. They are found in four steps:
//   (a) shells: sides of triangles are joined where they face each other around an edge
//       (detail/radial_sort.hpp);
//   (b) nesting: shells that bound the same volume are found by exact lines
//       (detail/shell_nesting.hpp);
//   (c) numbers: blocks are sorted by their lexicographically least vertex; blocks that share it,
//       by the sorted list of all their vertices, then by their least triangle. So the numbers
//       depend on the points only, not on the order of files, surfaces, triangles or threads;
//   (d) measures: exact volumes, rounded to doubles (detail/exact_volumes.hpp).
// Cost: linear, plus sorting the vertices; predicates only at edges with more than two triangles.
// Source: the paper, section 3, last remark (regions in one dimension more), without tetrahedra.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// The volumes of a mesh or an arrangement; 0 is the outside.
struct Volumes {
    /// Per triangle: the volume in front of it (from where its corners are counterclockwise) and
    /// the volume behind it. They are equal if the triangle dangles, as at a fault tip.
    std::vector<std::array<std::uint32_t, 2>> of_sides;
    /// Per volume, in cubic units of the input: the double nearest to the exact measure (ties to
    /// even; infinite beyond the largest double). [0] is infinite: the outside has no end.
    std::vector<double> measures{std::numeric_limits<double>::infinity()};
    double total = 0; ///< the double nearest to the sum of the exact measures of all blocks

    /// Returns the number of blocks, without the outside.
    [[nodiscard]] std::size_t block_count() const { return measures.size() - 1; }
    /// Whether the same volume is on both sides of a triangle.
    [[nodiscard]] bool dangles(std::size_t triangle) const {
        return of_sides[triangle][0] == of_sides[triangle][1];
    }
};

/// Finds the volumes of an arrangement. Times: shells, nesting, numbers and measures, the four
/// steps. Errors: interrupted, out_of_memory; internal if triangles are found to overlap, so that
/// it is no arrangement.
Result<Volumes> find_volumes(const Arrangement& arrangement, const Run& run = {});

/// Finds the volumes of a conforming mesh of doubles (see check.hpp, rounding.hpp).
/// Errors: as above; bad_index, bad_number.
Result<Volumes> find_volumes(const Mesh& mesh, const Run& run = {});

/// Exact measures as reduced fractions: "1", "125/6".
struct ExactVolumes {
    std::vector<std::string> measures; ///< per volume; [0] is empty: the outside has no end
    std::string total;                 ///< of all blocks: measures[1] + measures[2] + ...
};

/// Returns the exact measures in a base (see fraction.hpp).
/// Cost: a number has about as many digits as all constructed corners of its block together; 10 000
/// such corners take seconds, 100 000 take minutes.
ExactVolumes exact_volumes(const Arrangement& arrangement, const Volumes& volumes, int base = 10);
/// The same for a mesh of doubles.
ExactVolumes exact_volumes(const Mesh& mesh, const Volumes& volumes, int base = 10);

/// Matches the blocks of a rounded mesh with those of its exact arrangement: returns, per volume of
/// the mesh, its number among `exact`, or UINT32_MAX if rounding made it. [0] is 0; no number
/// occurs twice. Blocks are matched by the triangles that both have (with corners at the doubles
/// nearest to the exact ones); the pair with the most common triangles is matched first. Defined in
/// detail/match.cpp.
std::vector<std::uint32_t> match_volumes(const Arrangement& arrangement, const Volumes& exact,
                                         const Mesh& mesh, const Volumes& rounded);

/// Renumbers volumes by their matches, of which there are `exact` including the outside; volumes
/// without a match follow after these. A number that no volume matches becomes a block without
/// triangles, of measure 0: it was too thin for doubles. Defined in detail/match.cpp.
Volumes renumbered(const Volumes& volumes, std::span<const std::uint32_t> match, std::size_t exact);

// The blocks in which many points lie, found exactly; and a point inside each block, for programs that
// find blocks from points (TetGen).

/// A point inside a volume.
struct BlockPoint {
    Point3 place;    ///< strictly inside, in the unit of the mesh
    BlockId block{}; ///< number of the block
};

/// Returns for each point, which is finite, the volume that contains it; 0 is the outside. A point on
/// a triangle counts to the volume on the side of greater x; where the triangle is parallel to x, of
/// greater y, and where it is parallel to y as well, of greater z: it is shifted by
/// (e, e^2, e^3) for an infinitely small e. `volumes` are those of the mesh, which is conforming.
/// A vertical line upward from each point is searched for the lowest triangle above it, in a tree of
/// boxes in the map; doubles decide only where their error is bounded, exact numbers elsewhere.
/// Cost: n log n for n triangles; per point log n and the number of triangles on its line. Errors:
/// interrupted; internal if triangles are found to overlap.
Result<std::vector<std::uint32_t>> locate_points(std::span<const Point3> points, const Mesh& mesh,
                                                 const Volumes& volumes, const Run& run = {});

/// Returns one point for each block, in their order; a block in which no point with coordinates in
/// doubles was found has none. A candidate, half way from the middle of a large triangle to the
/// triangle that it faces, is verified by volume_around. `volumes` are those of the mesh, which is
/// conforming.
/// Cost: a few passes over the triangles per block. Errors: interrupted.
Result<std::vector<BlockPoint>> block_points(const Mesh& mesh, const Volumes& volumes,
                                             const Run& run = {});

/// Returns the volume that contains a point, by exact tests of a segment from it to the outside;
/// none if the point lies on a triangle, or if every segment that was tried meets an edge.
std::optional<BlockId> volume_around(const Point3& place, const Mesh& mesh, const Volumes& volumes);

} // namespace terrane
