// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the helper programs terrane-tetgen and terrane-gmsh, which alone are linked with TetGen and
// Gmsh.
#pragma once

#include <filesystem>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// Returns the path of the helper program. It is `given` unless that is empty; else what the
/// environment variable TERRANE_TETGEN names, if it is set and not empty; else the first of these
/// that exists: terrane-tetgen in the folder of the running program, in ../libexec/terrane/ from
/// there, in ../libexec/terrane/ and ../../libexec/terrane/ from the folder of the shared library
/// that contains Terrane, if one does, and in the folder where Terrane was to be installed when it
/// was built.
///
/// Errors: cannot_open, with the places that were looked at.
Result<std::filesystem::path> find_tetgen_helper(const std::filesystem::path& given = {});

/// Returns the path of Gmsh's helper program, which is found in the same way: terrane-gmsh, and the
/// environment variable TERRANE_GMSH.
Result<std::filesystem::path> find_gmsh_helper(const std::filesystem::path& given = {});

} // namespace terrane
