// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writing a model with its blocks for GOCAD (.ml), and its lines (.pl).
#pragma once

#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Returns a Model3d called `name` and its TSurfs, as RINGMesh and read_gocad_model read them. z
/// points up; `unit` is that of all coordinates, or empty.
/// - Each surface that has triangles is a TSurf, and each patch a TFACE of it. The triangles of a
///   patch between two volumes are wound alike, as the first of them; vertices that an earlier TFACE
///   of the surface has are ATOMs. BSTONE and BORDER are the corners and lines around the patch.
/// - The REGION Universe is the outside; the others are the blocks that have triangles, under their
///   names. + is the side from which the corners of a triangle appear counterclockwise. A patch that
///   dangles is listed with both signs. A patch of several surfaces is a TFACE of each of them; that
///   of the first one is listed.
/// - There is a LAYER for each unit of a stratigraphic column, or layer, that blocks have.
/// - Names are made different for all surfaces; braces in them become parentheses, and a block
///   that is called like the outside gets _2.
/// Coordinates read back as the same doubles. `volumes` and `structure` are those of the mesh.
/// Defined in detail/write_model.cpp. Cost: that of sorting the edges of each patch.
std::string to_gocad_model(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                           std::string_view name, std::string_view unit = {});

/// Returns a PLine for each kind of line and each set of surfaces that meet there: "cutoff line of
/// top and F1". Each line of the structure is an ILINE; a closed one ends with a SEG to its first
/// vertex. Errors: nothing_to_do if there is no line; the place is empty. Defined in
/// detail/write_curves.cpp.
Result<std::string> lines_to_gocad(const Mesh& mesh, const Structure& structure);

} // namespace terrane
