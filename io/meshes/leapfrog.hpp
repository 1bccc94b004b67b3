// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading meshes of Leapfrog (.msh), which have their extension in common with Gmsh.
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Whether contents begin as a mesh of Leapfrog does.
bool is_leapfrog(std::string_view contents);

/// Reads one Surface called `name` of an index in text ("Location Double 3 N;" and "Tri Integer 3 M;")
/// and the binary arrays that it lists, in either byte order. Other arrays are passed over. Errors:
/// bad_syntax, bad_number, bad_index with the line or the byte; nothing_to_do without triangles. Cost:
/// linear.
Result<std::vector<Surface>> read_leapfrog(std::string_view contents, std::string_view source,
                                           std::string_view name);

} // namespace terrane
