// SPDX-License-Identifier: LGPL-3.0-or-later
//
// From the surfaces of a project to its model: holes filled, horizons put in order, surfaces cut by
// a volume of interest, sealed and extended, arranged, rounded, improved, blocks found and filled
// with tetrahedra; each of them where the project asks for it. Files are read and written by the caller:
//
//   const auto project = terrane::read_project("project.json");              // io/project.hpp
//   auto inputs = terrane::read_inputs(*project);                            // io/project_inputs.hpp
//   const auto built = terrane::build(*project, std::move(inputs->build));
//
// Each mesh that is made is proven conforming once, and searched for volumes once.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/project/preprocess.hpp>
#include <terrane/algorithms/project/project.hpp>
#include <terrane/algorithms/quality/improve_measured.hpp>
#include <terrane/algorithms/tetgen/fill_blocks.hpp>

namespace terrane {

/// What the files of a project hold.
struct BuildInput {
    std::vector<Surface> surfaces{}; ///< with the names and roles that the project gives them
    std::vector<Surface> boundary{}; ///< of the volume of interest; empty: there is none
};

/// Stages in their order. A stage that the project does not ask for is left out.
enum class BuildStage : std::uint8_t { preprocess, arrange, improve, blocks, tetrahedra };

/// The model of a project, and what each stage did.
struct Built {
    Preprocessed preprocessed{};
    std::vector<std::string> labels{}; ///< per surface of the mesh: its name, made unique
    Arranged arranged{};
    std::optional<ImprovedAndMeasured> improved{}; ///< where the project asks for it
    std::optional<Model> model{};                  ///< there at the end
    std::optional<FilledBlocks> filled{};          ///< where the project has outputs.tetrahedra
};

/// Is told what is going on. Calls come from the thread that called build.
struct BuildObserver {
    std::function<void(BuildStage)> begins{};
    std::function<void(BuildStage, const Built&)> ended{}; ///< with what was built so far
};

/// What a project asks for; places are those of its keys.
TetrahedraRequest request_of(const Project& project);

/// Builds the model of a project. Errors: those of the stages; bad_option with "source: key" for a name in the project that no
/// surface has; improper_contact where preprocessing failed (see Preprocessed::good) or the rounded
/// mesh is not conforming: the observer has seen how far it came. Violations that the checks of
/// tetrahedra find are no error: see filled->report.
Result<Built> build(const Project& project, BuildInput input, const Run& run = {},
                    const BuildObserver& observer = {});

} // namespace terrane
