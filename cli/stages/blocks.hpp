// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The blocks of a model as text, as statistics and as a folder: what volume and build share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/cli/stages/pipeline.hpp>

namespace terrane::cli {

/// Makes the model of what was arranged, and adds to `statistics`. Precondition: the rounded mesh is
/// conforming. Errors: those of make_model.
Result<Model> find_model(const Arranged& arranged, Session& session, Json& statistics);

/// Adds what is known of the model to `statistics`.
void add_statistics(Json& statistics, const Model& model);

/// Blocks, structure, what dangles, leaks.
std::string model_text(const Inputs& inputs, const Model& model);

/// model.json (with what was sealed, if anything), result.vtp, blocks, interfaces (`part_format`:
/// vtp or obj), in a folder that is there and empty. Errors: those of writing; interrupted.
Status write_model(const Model& model, const std::optional<SealReport>& sealed,
                   const std::string& part_format, const std::filesystem::path& folder,
                   const Session& session);

} // namespace terrane::cli
