// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The faces of all tetrahedra, grouped by their corners, and what lies on each.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/tetrahedra/detail/findings.hpp>
#include <terrane/algorithms/tetrahedra/detail/places.hpp>
#include <terrane/kernel/numbers.hpp>

namespace terrane::tetrahedra::detail {

/// The relation of the faces to triangles and blocks.
struct FaceResult {
    std::vector<Exact> six_volumes;     ///< per volume: six times that of its tetrahedra
    IndexLists<std::uint32_t> faces_of; ///< per triangle: faces that name it; of twins, the front
};

/// Checks that
///   - no face has two tetrahedra on one side, and each one with a single tetrahedron is on the
///   box,
///     or on a triangle beyond which there is nothing to fill;
///   - each listed face is a face of a tetrahedron, is listed once, and has the surfaces of its
///     triangle;
///   - the tetrahedra in front of and behind a listed face are in the volumes on these sides of its
///     triangle, and two tetrahedra with another face in common are in one volume;
///   - twins are in front of and behind their triangle, and nodes are shared but for cuts.
/// A face of two tetrahedra in one volume adds nothing to the sum of volumes; only the others are
/// added up.
FaceResult check_faces(const Subject& subject, const Places& places);

/// Six times the volume of the tetrahedron with the corners a, b, c and the origin.
Exact six_volumes(const Point3& a, const Point3& b, const Point3& c);

} // namespace terrane::tetrahedra::detail
