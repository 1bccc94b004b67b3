// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the arrangement of two surfaces with CGAL's corefinement in its exact kernel: for each
// input triangle the points, the number of parts and the area; the intersection edges; for two
// closed surfaces the volumes of the four Booleans. The conditions of CGAL on its input are tested
// first.
#pragma once

#include <terrane/algorithms/arrangement/arrangement.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace corefine_oracle {

/// The result of a comparison. CGAL's answer counts only if none of its conditions is violated.
struct Outcome {
    std::string flaw;          ///< a difference between the answers; empty if there is none
    std::string skipped;       ///< the condition that is violated, or the refusal of CGAL
    std::size_t crossing = 0;  ///< intersection edges
    bool with_volumes = false; ///< the Booleans were compared too
};

/// Compares the arrangement of two surfaces with CGAL's corefinement.
Outcome compare(std::span<const terrane::Surface> pair, const terrane::Arrangement& a);

/// What CGAL makes of two surfaces, with corners at doubles near the exact ones.
struct MadeByCgal {
    std::vector<terrane::Surface> corefined; ///< both
    std::array<std::optional<terrane::Surface>, 4>
        booleans; ///< union, intersection, first minus second, second minus first; none where CGAL
                  ///< makes none
};

/// Returns what CGAL makes; nothing if one of its conditions is violated.
std::optional<MadeByCgal> made_by_cgal(std::span<const terrane::Surface> pair);

} // namespace corefine_oracle
