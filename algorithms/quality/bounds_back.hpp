// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Bounds the distance from the original surfaces to the improved ones: the other half of the
// Hausdorff distance (improve() bounds the first half).
#pragma once

#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/quality/improve.hpp>

namespace terrane {

/// Computes, for each surface, an upper bound of the one-sided Hausdorff distance from the original
/// to the improved surface: the surface's report.bound_of or, where that can't be proven, two, four
/// or eight times as much, or infinity. The proof runs over each triangle of each sheet as in
/// improve(), with rounding errors included (see detail/reference_surface.hpp). `options` must be
/// those given to improve(). Errors: interrupted, out_of_memory. Cost: a small part of improve's.
Result<std::vector<double>> bounds_back(const Mesh& before, const Improved& after,
                                        const ImproveOptions& options = {}, const Run& run = {});

} // namespace terrane
