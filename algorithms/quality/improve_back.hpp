// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How far a surface as it was is from the improved one: the other half of the Hausdorff distance.
#pragma once

#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/quality/improve.hpp>

namespace terrane {

/// Per surface: no point of it as it was is farther from it as it is now. That is the bound of the
/// surface (report.bound_of) or, where this can't be shown, twice, four or eight times as much, or
/// infinity. Shown for each triangle of each sheet as improve does it in the other direction, with
/// rounding errors counted in (see improve_reference.hpp). `options`: those of improve.
/// Errors: interrupted, out_of_memory. Cost: a small part of improve's.
Result<std::vector<double>> bounds_back(const Mesh& before, const Improved& after,
                                        const ImproveOptions& options = {}, const Run& run = {});

} // namespace terrane
