// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A project file describes the whole chain from surfaces to tetrahedra in JSON. Its schema is
// project.schema.json, in this folder; a test compares the two. build_model() makes the model of a
// project, whether a file or a program has stated it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/algorithms/structure/block_names.hpp>

namespace terrane {

/// Parses a project. Paths that are not absolute are taken relative to `base`, the folder of the
/// project file; `source` names the file in messages. The files of surfaces are not opened.
/// Errors: bad_syntax with "source:line"; bad_option with "source: surfaces[2].role" and the
/// expected value, for a key that is missing, unknown (with a suggestion) or repeated, and for a
/// value of the wrong type, out of range, or not among the choices.
Result<Project> parse_project(std::string_view text, const std::filesystem::path& base,
                              std::string_view source);

/// Reads and parses a project file. Errors: cannot_open, and those of parse_project.
Result<Project> read_project(const std::filesystem::path& path);

/// Returns all keys that parse_project knows, in the form "surfaces[].role", sorted.
std::vector<std::string> project_keys();

// A stratigraphic column in a file of its own: a JSON object with the key column, which means what
// it does in a project file.

/// Parses a column; `source` names the file in messages. Errors: bad_syntax, bad_option with the
/// key, as parse_project() has them; those of check_column().
Result<StratigraphicColumn> parse_column(std::string_view text, std::string_view source);

/// Reads and parses a column. Errors: cannot_open, and those of parse_column.
Result<StratigraphicColumn> read_column(const std::filesystem::path& path);

// The files that a project names, read, and the model of a project.

/// The surfaces of a project as read from its files.
struct ProjectInputs {
    BuildInput build;                             ///< the input of terrane::build
    std::vector<SurfaceInfo> as_read{};           ///< per surface: name and role in its file
    std::vector<std::size_t> surfaces_of_entry{}; ///< per entry of "surfaces": how many
    std::string unit{};                           ///< of all coordinates, where files state one
    std::size_t vertices = 0,                     ///< number in all surfaces
        triangles = 0;                            ///< number in all surfaces
};

/// Makes the boundary of a volume of interest; empty where there is none. Coordinates of files are
/// converted to `unit`, unless that is empty. Errors: those of read_surfaces and of the makers in
/// volume_of_interest.hpp.
Result<std::vector<Surface>> boundary_of(const ProjectVolume& volume, const std::string& unit,
                                         const Run& run = {});

/// Returns the files that a project names: of surfaces, of its volume of interest, and maps of how
/// uncertain they are.
std::vector<std::filesystem::path> named_files(const Project& project);

/// Reads the surfaces and makes the boundary of the volume of interest. Errors: those of
/// read_surfaces and of the makers in volume_of_interest.hpp; bad_option with the key of an object
/// that a file does not have, or of a name for several surfaces; unsupported where 32 bits can't
/// count everything; interrupted.
Result<ProjectInputs> read_inputs(const Project& project, const Run& run = {});

/// Reads the files of a project and builds its model. Errors: those of read_inputs() and build().
Result<Built> build_model(const Project& project, const Run& run = {});

/// Builds the model of surfaces in memory. Entries of project.surfaces, if there are any, stand for one
/// surface each and give it their name and role; their files are not read. Errors: bad_option (another number of
/// surfaces than of entries); those of validate(), boundary_of() and build().
Result<Built> build_model(Project project, std::vector<Surface> surfaces, const Run& run = {});

} // namespace terrane
