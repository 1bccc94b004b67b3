// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Geomview OFF.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Reads one Surface called `name`, with all vertices of the file. The variants OFF, COFF, NOFF,
/// STOFF and their combinations are read; colours, normals and texture coordinates are ignored. The
/// keyword may be missing, and the counts may follow it on the same line; '#' begins a comment.
/// Each line has one vertex or face. Faces are divided as append_face() does
/// (algorithms/triangulation/face.hpp).
/// Errors: bad_syntax, bad_number, bad_index with "source:line"; nothing_to_do if there is no face;
/// unsupported for 4OFF, nOFF and OFF BINARY.
Result<std::vector<Surface>> read_off(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Writes all vertices and triangles; OFF cannot express surfaces. Numbers read back as the same
/// doubles.
std::string to_off(const Mesh& mesh);

} // namespace terrane
