// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on an improved mesh.
#pragma once

#include <string>

#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Warns if the volume of a block changed by more than the options allow. Returns whether the run may
/// succeed: if none did, or warnings are no errors.
bool keeps_volumes(const ImprovedAndMeasured& measured, bool strict,
                   const ImproveOptions& options = {});

/// Reports quality before and after, the worst triangle, and the deviation both as proven and as
/// measured.
std::string improve_text(const ImprovedAndMeasured& measured, const Inputs& inputs);

/// Adds "improve" (counts of operations), "quality" (before, after), "deviation" and the times.
void add_statistics(Json& json, const ImprovedAndMeasured& measured);

/// Draws the histograms of triangle quality as SVG, after the paper's Figure 19.
std::string histogram_of(const ImproveReport& report);

} // namespace terrane::cli
