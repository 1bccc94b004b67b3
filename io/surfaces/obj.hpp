// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Wavefront OBJ.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Reads one Surface per group that has faces, in the order of their first faces.
/// - A `g` or `o` line names the group of the faces that follow; the last such line counts. Faces
///   before the first one, or after one without a name, are in the group `name`. A `g` line with
///   several names (at most 256) puts its faces into each of these surfaces. `usemtl` changes the
///   appearance only and has no effect.
/// - A surface has only the vertices that it uses, in file order.
/// - The corners of a face are written `v`, `v/t`, `v//n` or `v/t/n`, with indices that count from
///   1 or are negative. Faces are divided as append_face() does (algorithms/triangulation/face.hpp).
///   Weights and colours after `v x y z` are ignored. A backslash at the end of a line joins it with the next line.
/// Errors: bad_syntax, bad_number, bad_index with "source:line"; nothing_to_do if there is no face.
/// Cost: linear; one pass over `contents`.
Result<std::vector<Surface>> read_obj(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Writes all vertices, then the triangles in order. A group line precedes each run of triangles
/// with the same surfaces; a triangle of several surfaces is written once, under a group line with
/// all their names (`g top_reservoir main_fault`). Blanks in names become underscores; equal names
/// are told apart by _2, _3. Numbers read back as the same doubles.
std::string to_obj(const Mesh& mesh);

} // namespace terrane
