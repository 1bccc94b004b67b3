// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes the files that a project asks for, and the folder of a model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/io/project.hpp>

namespace terrane {

struct StructureExtras;

// The folder of files that a model is written to, as `terrane volume` makes it.

/// A model with its sealing and its leaks; by reference: the values must outlive it.
struct ModelReports {
    const Model& model;                      ///< the model to write
    const std::optional<SealReport>& sealed; ///< the report of sealing; none: not sealed
    const std::optional<LeakAdvice>& leaks;  ///< leaks that were judged; none: they were not
    std::span<const SurfaceValues>
        values{}; ///< on the model's mesh, for result.vtp; parts have none
};

/// Returns what model.json says of a model beyond its structure, but for the names of files.
StructureExtras extras_of(const ModelReports& reports);

/// A file of the folder of a model.
struct ModelFile {
    std::filesystem::path path; ///< relative to the folder
    std::string format;         ///< "json", "vtp", or that of blocks and interfaces
};

/// The format of blocks and interfaces that writes a VTP file of each, or, where they are more than
/// most_single_parts, all blocks to blocks.vtp and all interfaces to interfaces.vtp.
inline constexpr const char* automatic_parts = "auto";
inline constexpr std::size_t most_single_parts = 1000;

/// Lists the files that say what a model is: model.json, result.vtp, and those of blocks and
/// interfaces in `part_format`. model.vtm, which only names others, is not among them.
std::vector<ModelFile> model_files(const Model& model, const std::string& part_format);

/// Lists the names of the formats of blocks and interfaces.
std::vector<std::string> part_formats();
/// Tells whether a certificate can be about blocks and interfaces in this format.
bool is_certified(const std::string& part_format);

/// Writes model.json (with the reports of sealing and leaks), result.vtp, and the blocks and
/// interfaces in `part_format` into an empty folder that exists; as VTP also model.vtm, which has
/// all these files under the names of their contents. Errors: those of write_mesh; interrupted.
Status write_model_files(const ModelReports& reports, const std::string& part_format,
                         const std::filesystem::path& folder, const Run& run = {});

/// Does the same into a folder that does not exist, or is empty, and appears when it is complete.
/// Errors: as above; unknown_format; cannot_open if the folder cannot be made.
Status write_model_folder(const ModelReports& reports, const std::string& part_format,
                          const std::filesystem::path& folder, const Run& run = {});

/// The results of building a project, by reference.
struct Results {
    const Project& project;                  ///< whose `outputs` names the files to write
    const Model& model;                      ///< as built
    const FilledBlocks* filled;              ///< nullptr: there are no tetrahedra
    const std::optional<SealReport>& sealed; ///< none: nothing was sealed
    const std::optional<LeakAdvice>& leaks;  ///< none: leaks were not judged
    std::string unit{};                      ///< of the coordinates; empty: unknown
    std::span<const SurfaceValues>
        values{}; ///< on the model's mesh; none where there are certificates
    std::span<const SurfaceValues> values_of_faces{}; ///< likewise of the tetrahedra
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
