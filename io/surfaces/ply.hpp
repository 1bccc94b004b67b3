// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stanford PLY: ASCII, binary little endian, binary big endian.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Reads one Surface called `name` with all vertices of the file. All scalar and list types are
/// understood; further elements are skipped. Scalar properties of vertices and faces become arrays, but for normals.
/// Faces are divided as append_face() does (algorithms/triangulation/face.hpp). Coordinates in ASCII are read as
/// doubles, whatever type the header declares. From a file
/// written by to_ply the original surfaces are read, each with the vertices that it uses.
/// Errors: bad_syntax, bad_number, bad_index with "source:line" or "source, byte n"; nothing_to_do
/// if there is no face; unsupported for triangle strips.
Result<std::vector<Surface>> read_ply(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Writes binary PLY, little endian, with coordinates of type double and every triangle once. A
/// face has the properties `surface` (its first surface) and `surfaces` (the list of all of them);
/// comments "terrane surface ROLE NAME" in the header name the surfaces in order. `values` per surface, as from
/// carry_values(), are further properties, one per component, after a comment "terrane values vertex COMPONENTS
/// NO_DATA UNIT NAME" (or face); "-" stands for nothing. Integers of 64 bits become doubles, which PLY has.
/// Defined in ply_writer.cpp.
std::string to_ply(const Mesh& mesh, std::span<const SurfaceValues> values = {});

} // namespace terrane
