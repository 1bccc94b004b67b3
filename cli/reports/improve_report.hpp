// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What is said about an improved mesh.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/quality/deviation.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// A better mesh, and how far it is from the one before.
struct Measured {
    Improved improved;
    std::vector<Deviation> deviations; ///< per surface, measured
    std::vector<double> bounds_back; ///< per surface: no point of it before is farther from it now

    /// Whether that is shown to be within the bounds as well.
    [[nodiscard]] bool is_near_back() const;
};

/// Quality before and after, the worst triangle, the deviation as shown and as measured.
std::string improve_text(const Measured& measured, const Inputs& inputs);

/// Key "improve": options' effect, counts of operations; "quality": before, after; "deviation".
void add_statistics(Json& json, const Measured& measured);

/// SVG, as in the paper's Figure 19.
std::string histogram_of(const ImproveReport& report);

/// Improves, and measures what was promised with other code. Adds the times to `statistics`.
/// Errors: those of improve; interrupted; internal where the promise is broken.
Result<Measured> improve_and_measure(const ConformingMesh& mesh, const ImproveOptions& options,
                                     Session& session, Json& statistics);

} // namespace terrane::cli
