// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The arrangement of two surfaces against CGAL's corefinement in its exact kernel: for each input
// triangle the same points, number of parts and area; the same intersection edges; of two closed
// surfaces the volumes of the four Booleans. What CGAL asks of its input is tested first.
#pragma once

#include <terrane/algorithms/arrangement/arrangement.hpp>

#include <span>
#include <string>

namespace corefine_oracle {

/// What came of a comparison. CGAL's answer counts where none of its conditions is broken.
struct Outcome {
    std::string flaw;          ///< where the answers differ; empty if nowhere
    std::string skipped;       ///< the condition that is broken, or what CGAL declines
    std::size_t crossing = 0;  ///< intersection edges
    bool with_volumes = false; ///< the Booleans were compared too
};

/// Compares the arrangement of two surfaces with CGAL's corefinement.
Outcome compare(std::span<const terrane::Surface> pair, const terrane::Arrangement& a);

} // namespace corefine_oracle
