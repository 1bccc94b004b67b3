// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares a mesh with the cells of a target: steps (2) and (3) of judge.hpp.
#pragma once

#include <cstdint>
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
    double largest_move = 0; ///< of a vertex
    double missing_area = 0, extra_area = 0;
    std::vector<Placed> placed; ///< per triangle of the output

    explicit Comparison(std::size_t most_flaws);
};

/// Compares the mesh; no two of its points coincide.
Comparison compare(const Target& target, const OutputMesh& output, double bound,
                   std::size_t most_flaws);

/// Appends the properties that a comparison found, with their sentences.
void add_compared(Comparison& found, double bound, std::vector<JudgedProperty>& properties);

} // namespace terrane::judging
