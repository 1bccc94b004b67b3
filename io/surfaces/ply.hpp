// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stanford PLY: ASCII, binary little endian, binary big endian.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// One Surface called `name` with all vertices of the file. Any scalar and list types, any further
/// elements and properties; polygons become fans around their first corner. ASCII numbers are read
/// as doubles whatever type the header gives them.
/// A file that to_ply wrote gives its surfaces back, each with the vertices that it uses.
/// Errors: bad_syntax, bad_number, bad_index with "source:line" or "source, byte n"; nothing_to_do
/// without a face; unsupported: triangle strips.
Result<std::vector<Surface>> read_ply(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Binary little endian, coordinates as double, every triangle once. Faces have `surface` (first
/// surface) and the list `surfaces` (all of them); comments "terrane surface ROLE NAME" in the
/// header name them in order.
std::string to_ply(const Mesh& mesh);

} // namespace terrane
