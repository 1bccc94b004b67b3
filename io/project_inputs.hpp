// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The files that a project names, read, and the model of a project.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/project/build.hpp>
#include <terrane/algorithms/project/project.hpp>

namespace terrane {

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
/// boundary_surfaces.hpp.
Result<std::vector<Surface>> boundary_of(const ProjectVolume& volume, const std::string& unit,
                                         const Run& run = {});

/// Returns the files that a project names: of surfaces, of its volume of interest, and maps of how
/// uncertain they are.
std::vector<std::filesystem::path> named_files(const Project& project);

/// Reads the surfaces and makes the boundary of the volume of interest. Errors: those of
/// read_surfaces and of the makers in boundary_surfaces.hpp; bad_option with the key of an object
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
