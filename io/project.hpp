// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A project file describes the whole chain from surfaces to tetrahedra in JSON. Its schema is
// project.schema.json, in this folder; a test compares the two.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/project/project.hpp>

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

} // namespace terrane
