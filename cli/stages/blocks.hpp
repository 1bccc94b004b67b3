// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Blocks of a model as text and statistics: shared by `volume` and `build`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// Adds the model's counts, volumes and times to the statistics.
void add_statistics(Json& statistics, const Model& model);

/// Reports the parts of blocks above contacts, levels of z, and adds them to the statistics.
std::string contacts_text(const Inputs& inputs, const Model& model,
                          const std::vector<double>& contacts, Json& statistics);

/// Judges the leaks of an arrangement. Returns none if it was sealed, if no surface ends, or on an error.
std::optional<LeakAdvice> judge_leaks(const Arranged& arranged, const Model& model,
                                      Session& session);

/// Reports blocks, structure, dangling surfaces and leaks, which may have been judged.
std::string model_text(const Inputs& inputs, const Model& model,
                       const std::optional<LeakAdvice>& advice);

} // namespace terrane::cli
