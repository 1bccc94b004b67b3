// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What is said about an improved mesh.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/deviation.hpp>
#include <terrane/algorithms/improve.hpp>
#include <terrane/cli/statistics.hpp>

namespace terrane::cli {

/// Quality before and after, the worst triangle, the deviation as shown and as measured.
std::string improve_text(const Improved& improved, std::span<const Deviation> deviations,
                         const Inputs& inputs);

/// Key "improve": options' effect, counts of operations; "quality": before, after; "deviation".
void add_statistics(Json& json, const Improved& improved, std::span<const Deviation> deviations);

/// SVG, as in the paper's Figure 19.
std::string histogram_of(const ImproveReport& report);

} // namespace terrane::cli
