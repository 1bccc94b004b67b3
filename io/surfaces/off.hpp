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

/// One Surface called `name`, with all vertices of the file.
/// OFF, COFF, NOFF, STOFF and their combinations: colours, normals and textures are not read. The
/// keyword may be missing, the counts may stand beside it, '#' begins a comment. One vertex or
/// face per line; polygons become fans around their first corner.
/// Errors: bad_syntax, bad_number, bad_index with "source:line"; nothing_to_do without a face;
/// unsupported: 4OFF, nOFF and OFF BINARY.
Result<std::vector<Surface>> read_off(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// All vertices and triangles; OFF has no place for surfaces. Numbers read back as the same
/// doubles.
std::string to_off(const Mesh& mesh);

} // namespace terrane
