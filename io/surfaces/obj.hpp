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

/// One Surface per group that has faces, in the order in which the groups first get one.
/// - `g` and `o` name the group of the faces that follow, whichever came last; without a name it
///   is `name`. A `g` line with several names puts the faces in each of these surfaces (at most
///   256). `usemtl` is appearance, not a surface, and has no effect.
/// - A surface has the vertices that it uses, in file order.
/// - Faces `f v`, `v/t`, `v//n`, `v/t/n`, indices from 1 or negative; polygons become fans around
///   their first corner. Weights and colours after `v x y z` are not read. A backslash at the end
///   of a line joins it with the next one.
/// Errors: bad_syntax, bad_number, bad_index with "source:line"; nothing_to_do without a face.
/// Cost: linear; one pass over `contents`.
Result<std::vector<Surface>> read_obj(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Vertices, then the triangles in order, each run of equal surfaces under one group line:
/// a triangle of several surfaces stands once, in a group line with all their names
/// (`g top_reservoir main_fault`). Blanks in names become underscores, equal names are told apart
/// by _2, _3. Numbers read back as the same doubles.
std::string to_obj(const Mesh& mesh);

} // namespace terrane
