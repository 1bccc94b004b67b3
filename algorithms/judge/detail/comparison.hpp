// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares a mesh with the cells of a target: steps (2) and (3) of judge.hpp.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/judge/detail/matching.hpp>
#include <terrane/algorithms/judge/detail/properties.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>
#include <terrane/algorithms/judge/judge.hpp>

namespace terrane::judging {

/// Where a triangle of the output is.
struct Placed {
    std::uint32_t triangle = no_index; ///< of the target, in the same cell; or no_index
    int facing = 0;                    ///< 1 if it is wound as that one, else -1
};

/// What a comparison found.
struct Comparison {
    Flaws welded, vertices, curves, coverage, topology, orientation;
    double largest_move = 0;      ///< of a vertex
    double largest_free_move = 0; ///< of one that shares no triangle with one near others
    double missing_area = 0, extra_area = 0;
    std::vector<Placed> placed; ///< per triangle of the output

    explicit Comparison(std::size_t most_flaws);
};

/// Compares the mesh; no two of its points coincide.
Comparison compare(const Target& target, const OutputMesh& output, const Bound& bound,
                   std::size_t most_flaws);

/// The properties of a mesh by some bound.
struct Judged {
    std::vector<JudgedProperty> properties;
    double largest_move = 0, largest_free_move = 0; ///< see Comparison
};

/// Judges by the bound. What fails is not judged if all holds or is in doubt
/// - where triangles with corners that have to move, as some at these meet improperly at the nearest doubles, are in
///   doubt, too; or
/// - by a wider bound as well, if vertices that are near others, or share triangles with these, and no others, moved
///   farther than the bound: rounding has to move surfaces that nearly coincide.
Result<MeshJudgement> judge_with_doubt(const Target& target, Bound bound, const Run& run,
                                       const std::function<Result<Judged>(const Bound&)>& judge_by);

/// Appends the properties that a comparison found, with their sentences, and notes its moves.
void add_compared(Comparison& found, double bound, Judged& judged);

} // namespace terrane::judging
