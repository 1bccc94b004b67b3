// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes the files that a project asks for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/leak_advice.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/project/project.hpp>
#include <terrane/algorithms/tetgen/fill_blocks.hpp>
#include <terrane/io/project_inputs.hpp>

namespace terrane {

/// The results of building a project, by reference.
struct Results {
    const Project& project;                  ///< whose `outputs` names the files to write
    const Model& model;                      ///< as built
    const FilledBlocks* filled;              ///< nullptr: there are no tetrahedra
    const std::optional<SealReport>& sealed; ///< none: nothing was sealed
    const std::optional<LeakAdvice>& leaks;  ///< none: leaks were not judged
    std::string unit{};                      ///< of the coordinates; empty: unknown
};

/// A certificate among the results.
struct WrittenCertificate {
    std::string name;     ///< of its file
    double deviation = 0; ///< that it states; 0: none
};

/// Returns a name such as "surfaces.obj". MSH 2.2 gets "surfaces_22.msh", so that both versions can
/// be written, and formats of simulators "tetrahedra_ogs.vtu" and so on.
std::string file_name(const std::string& start, const std::string& format);

/// Writes surfaces, tetrahedra, blocks and the GOCAD model into an empty folder that exists. Returns the
/// names of the files, folders with "/" at the end. Errors: those of write_mesh and
/// write_model_files; interrupted.
Result<std::vector<std::string>>
write_results(const Results& results, const std::filesystem::path& folder, const Run& run = {});

/// Checks that the results of a project can be certified, if it asks for that. Errors: bad_option.
Status check_certifiable(const Project& project);

/// Writes the certificates of the files of write_results(), if the project asks for them: of the
/// surfaces, the blocks and the tetrahedra. They call the surfaces as their files do. Errors: those of certify() and of writing.
Result<std::vector<WrittenCertificate>>
write_certificates(const Results& results, const ProjectInputs& read, const Arranged& arranged,
                   const std::filesystem::path& folder, const Run& run = {});

} // namespace terrane
