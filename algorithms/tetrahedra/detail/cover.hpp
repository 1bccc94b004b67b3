// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How the faces that name a triangle cover it.
#pragma once

#include <vector>

#include <terrane/algorithms/tetrahedra/detail/findings.hpp>
#include <terrane/algorithms/tetrahedra/detail/places.hpp>

namespace terrane::tetrahedra::detail {

/// Checks that the faces of each triangle cover it, and that triangles at one edge divide it at the
/// same nodes. faces_of: per triangle, the faces that name it. Returns, per triangle, whether it is
/// divided.
///
/// A triangle is covered if it is its only face, or if
///   (a) the sides of the faces, as they are wound, cancel each other but for a closed polygon, the
///       outline, that runs from corner to corner of the triangle;
///   (b) the nodes of the outline are near the edge that they are on, all others near the plane;
///   (c) in the projection along the axis on which the normal is longest, all faces are wound like
///       the triangle, and the outline is simple.
/// Statement (3) in docs/explanation/tetrahedra.md: their projections then tile the polygon.
std::vector<bool> check_cover(const Subject& subject, const Places& places,
                              const IndexLists<std::uint32_t>& faces_of);

} // namespace terrane::tetrahedra::detail
