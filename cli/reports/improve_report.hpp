// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What is said about an improved mesh.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/quality/improve_measured.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Quality before and after, the worst triangle, the deviation as shown and as measured.
std::string improve_text(const ImprovedAndMeasured& measured, const Inputs& inputs);

/// Key "improve": options' effect, counts of operations; "quality": before, after; "deviation".
void add_statistics(Json& json, const ImprovedAndMeasured& measured);

/// SVG, as in the paper's Figure 19.
std::string histogram_of(const ImproveReport& report);

} // namespace terrane::cli
