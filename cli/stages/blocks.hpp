// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Blocks of a model as text, statistics and a folder of files: shared by `volume` and `build`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/cli/stages/pipeline.hpp>

namespace terrane::cli {

/// Makes the model of the arrangement with the names that are given, and adds to `statistics`. Precondition: the rounded mesh is
/// conforming. Errors: those of make_model.
Result<Model> find_model(const Arranged& arranged, const BlockNaming& naming, Session& session,
                         Json& statistics);

/// Adds the model's counts, volumes and times to the statistics.
void add_statistics(Json& statistics, const Model& model, const StageTimes& times);

/// Reports blocks, structure, dangling surfaces and leaks.
std::string model_text(const Inputs& inputs, const Model& model);

/// Lists the names of the formats of blocks and interfaces.
std::vector<std::string> part_formats();

/// Writes model.json (with what was sealed, if anything), result.vtp, and the blocks and interfaces
/// in `part_format` into an empty folder that exists; with vtp also model.vtm, which has them all
/// under their names. Errors: those of writing;
/// interrupted.
Status write_model(const Model& model, const std::optional<SealReport>& sealed,
                   const std::string& part_format, const std::filesystem::path& folder,
                   const Session& session);

} // namespace terrane::cli
