// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The blocks of a model, what is said of them, and the folder that holds them: what volume and
// build share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/structure/free_borders.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/cli/stages/pipeline.hpp>

namespace terrane::cli {

/// All that is known of the model, by numbers of the exact blocks.
struct Model {
    Volumes exact;   ///< of the exact arrangement
    Volumes volumes; ///< of the mesh, with the numbers of the exact ones
    Structure structure;
    std::vector<FreeBorder> borders;
    std::size_t lost = 0; ///< exact blocks that the mesh does not have
    std::size_t made = 0; ///< blocks of the mesh that are no exact ones
};

/// Adds to `statistics`. Errors: those of find_volumes, interrupted.
Result<Model> make_model(const Arranged& arranged, Session& session, Json& statistics);

/// The same of a mesh alone: there are no other exact blocks than its own.
Result<Model> make_model(const Mesh& mesh, Session& session, Json& statistics);

/// Blocks, structure, what dangles, leaks.
std::string model_text(const Inputs& inputs, const Model& model);

/// model.json (with what was sealed, if anything), result.vtp, blocks, interfaces (`part_format`:
/// vtp or obj), in a folder that is there and empty. Errors: those of writing; interrupted.
Status write_model(const Mesh& mesh, const Model& model, const std::optional<SealReport>& sealed,
                   const std::string& part_format, const std::filesystem::path& folder,
                   const Session& session);

} // namespace terrane::cli
