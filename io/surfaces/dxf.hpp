// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading AutoCAD DXF: 3DFACE.
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Reads the 3DFACE entities of a DXF in text. Each layer with faces becomes a surface, in the
/// order of its first face; faces without a layer are in the surface `name`. A face whose fourth
/// corner repeats the third, or is missing, is a triangle; others become two triangles. Corners at
/// exactly the same place become one vertex. Other entities, and faces in blocks, are passed over.
/// Errors: bad_syntax, bad_number with "source:line"; unsupported (a binary file); nothing_to_do if
/// there is no face. Cost: linear.
Result<std::vector<Surface>> read_dxf(std::string_view contents, std::string_view source,
                                      std::string_view name);

} // namespace terrane
