// SPDX-License-Identifier: LGPL-3.0-or-later
//
// AutoCAD DXF: 3DFACE.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Reads the faces of a DXF in text: 3DFACE, polyfaces and polygon meshes (POLYLINE), MESH without
/// its subdivision, and those of blocks where INSERT places them. Each layer with faces becomes a
/// surface, in the order of its first face; faces without a layer are in the surface `name`. A
/// 3DFACE whose fourth corner repeats the third, or is missing, is a triangle. Faces are divided as
/// append_face() does (algorithms/triangulation/face.hpp). Corners at exactly the same place become
/// one vertex. Other entities are passed over.
/// Errors: bad_syntax, bad_number with "source:line"; bad_index (a face names no
/// vertex); unsupported (a binary file, blocks that make more faces than the file has bytes); nothing_to_do if
/// there is no face. Cost: linear.
Result<std::vector<Surface>> read_dxf(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Writes a 3DFACE for each triangle, on the layer called after its surface, in text of release 12. A triangle of
/// several surfaces is there once for each. In names blanks and AutoCAD's special characters become '_'; roles have
/// no place.
std::string to_dxf(const Mesh& mesh);

} // namespace terrane
