// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What a mesh should be: some triangles of an exact arrangement, and the flat regions (cells) they form.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/algorithms/mesh/edges.hpp>

namespace terrane::judging {

/// Triangles of an arrangement; vertices are those of the arrangement.
struct Target {
    const Arrangement& exact;
    std::vector<Triangle> triangles;   ///< wound as the output should be
    std::vector<std::uint32_t> source; ///< per triangle: that of the arrangement
    bool solid = false;                ///< they bound the result of an operation
    double volume = 0;                 ///< of that
};

/// How far points may be from where they should be.
struct Bound {
    double bound = 0;  ///< largest difference of a coordinate
    double reach = 0;  ///< not less, and not 0: grids of points have cells of some size
    double widest = 0; ///< that may be judged by: nearly all would be in doubt
    std::vector<std::uint32_t> clashing{}; ///< triangles of the target that are in doubt; ascending
};

/// Returns what is wrong with the options: bad_option (spacings).
Status check_options(const JudgeOptions& options);

/// Returns the bound: `spacings` times the spacing of doubles at the largest coordinate. Errors: unsupported
/// (a coordinate beyond 2^250 or all below 2^-250; a bound above a 4096th of the extent).
Result<Bound> bound_of(const Arrangement& exact, double spacings);

/// All triangles of an arrangement.
Target whole_arrangement(const Arrangement& exact);

/// The boundary of an operation. Errors: not_closed, bad_option, those of find_volumes().
Result<Target> boundary_of(const Arrangement& exact, const JudgeOptions& options, const Run& run);

/// A flat region: triangles that are joined across edges where two coplanar ones of the same surfaces
/// meet, and no intersection edge is. Of a solid, surfaces do not matter.
struct Cell {
    std::uint32_t triangle = 0; ///< one of its triangles
    Triangle plane{};           ///< three input points that span its plane
    Axis axis = Axis::z;        ///< along which it is projected
    Sign turn = Sign::Zero;     ///< of its triangles in that projection
    Point3 normal{};            ///< of length 1, to the front of its triangles
    double area = 0;            ///< in squared units of the input
    std::uint32_t parents = 1;  ///< input triangles at each of its points, not fewer
    bool either = false;        ///< its parents face both ways
};

/// An oriented edge of the boundary of a cell, which lies to its left.
struct CellEdge {
    std::uint32_t cell, from, to;
};

/// The cells of a target.
struct Cells {
    std::vector<Cell> cells;
    IndexLists<std::uint32_t> at_vertex; ///< per vertex: its cells, ascending
    std::vector<CellEdge> boundary;      ///< of all cells
    std::vector<Edge> edges;             ///< of `boundary`, without orientation; sorted, unique
    std::vector<Edge> borders;           ///< those with one triangle; sorted
    std::vector<Edge> curves;            ///< those that are intersection edges; sorted
};

/// Finds the cells. Cost: O(n log n).
Cells find_cells(const Target& target);

} // namespace terrane::judging
