// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares a mesh with the cells of a target: steps (2) and (3) of judge.hpp.
#pragma once

#include <vector>

#include <terrane/algorithms/judge/detail/matching.hpp>
#include <terrane/algorithms/judge/detail/properties.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>
#include <terrane/algorithms/judge/judge.hpp>

namespace terrane::judging {

/// What a comparison found.
struct Comparison {
    Flaws welded, vertices, curves, coverage, topology, orientation;
    double largest_move = 0; ///< of a vertex
    double missing_area = 0, extra_area = 0;

    explicit Comparison(std::size_t most_flaws);
};

/// Compares the mesh; no two of its points coincide.
Comparison compare(const Target& target, const OutputMesh& output, double bound,
                   std::size_t most_flaws);

} // namespace terrane::judging
