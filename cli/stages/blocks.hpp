// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Blocks of a model as text, statistics and a folder of files: shared by `volume` and `build`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/model/leak_advice.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/cli/stages/pipeline.hpp>

namespace terrane::cli {

/// Makes the model of the arrangement with the names that are given, and adds to `statistics`. Precondition: the rounded mesh is
/// conforming. Errors: those of make_model.
Result<Model> find_model(const Arranged& arranged, const BlockNaming& naming, Session& session,
                         Json& statistics);

/// Adds the model's counts, volumes and times to the statistics.
void add_statistics(Json& statistics, const Model& model, const StageTimes& times);

/// Judges the leaks of an arrangement, unless it was sealed or no surface ends. Errors: those of
/// terrane::judge_leaks.
Result<std::optional<LeakAdvice>> judge_leaks(const Arranged& arranged, const Model& model,
                                              Session& session);

/// Reports blocks, structure, dangling surfaces and leaks, which may have been judged.
std::string model_text(const Inputs& inputs, const Model& model,
                       const std::optional<LeakAdvice>& advice);

/// Lists the names of the formats of blocks and interfaces.
std::vector<std::string> part_formats();

/// A model, and what is known beside it.
struct ModelReports {
    const Model& model;
    const std::optional<SealReport>& sealed;
    const std::optional<LeakAdvice>& leaks;
};

/// Writes model.json (with what was sealed or judged, if anything), result.vtp, and the blocks and interfaces
/// in `part_format` into an empty folder that exists; with vtp also model.vtm, which has them all
/// under their names. Errors: those of writing;
/// interrupted.
Status write_model(const ModelReports& reports, const std::string& part_format,
                   const std::filesystem::path& folder, const Session& session);

} // namespace terrane::cli
