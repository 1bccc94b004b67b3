// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What a project names, read and made.
#pragma once

#include <string>
#include <vector>

#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/io/project.hpp>

namespace terrane::cli {

/// bad_option: what is wrong with this key of the project file `source`.
Error at_key(const std::string& source, const std::string& key, std::string sentence);

struct ProjectInputs {
    Inputs inputs;
    std::vector<SurfaceInfo> as_read; ///< per surface, as its file calls it
};

/// The surfaces, with the names and roles that the project gives them. `source`: the project file,
/// for messages. Errors: those of read_surfaces; bad_option with the key of an object that a file
/// does not have, or of a name for several surfaces.
Result<ProjectInputs> read_inputs(const Project& project, const std::string& source,
                                  Session& session);

/// The paths of the files, one per entry of "surfaces".
std::vector<std::string> files_of(const Project& project);

/// The boundary of the volume of interest; empty where the project has none. Errors: those of its
/// makers (boundary_surfaces.hpp) and of read_surfaces.
Result<std::vector<Surface>> boundary_of(const Project& project, const std::string& source,
                                         Session& session);

} // namespace terrane::cli
