// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Evaluates exact predicates on input points. Each tries doubles with a static bound, then
// intervals, then exact numbers. The result is correct for all finite doubles in any rounding mode.
//
// Laws (a test carries each number):
// (1) orient3d((0,0,0), (1,0,0), (0,1,0), (0,0,1)) is Positive.
// (2) An odd permutation of the arguments flips the sign of orient2d and orient3d; an even one
//     keeps it.
// (3) A repeated point gives Zero.
// (4) orient2d(Axis::z, (0,0,z), (1,0,z'), (0,1,z'')) is Positive, and cyclically for x and y: the
//     orientation of a triangle projected along an axis is the sign of its normal's coordinate
//     there.
// (5) in_circle is Positive for the centre of a counterclockwise circle. An odd permutation of the
//     first three arguments flips it. It is Zero if one of them is repeated as the fourth.
// (6) collinear holds iff orient2d is Zero along all three axes.
#pragma once

#include <terrane/kernel/config.hpp>

#include <optional>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

/// Returns the side of d with respect to the plane a, b, c: Positive where they appear
/// counterclockwise from d.
Sign orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Evaluates the static filter of orient2d; std::nullopt where it does not decide. It is cheap and
/// does not count in predicate_counts.
std::optional<Sign> filtered_orient2d(Axis axis, const Point3& a, const Point3& b, const Point3& c);

/// Returns Positive iff a, b, c turn left in the projection along `axis`.
Sign orient2d(Axis axis, const Point3& a, const Point3& b, const Point3& c);

/// Returns Positive iff direction c d lies to the left of direction a b in the projection, Zero iff
/// they are parallel there. turn2d(axis, a, b, a, c) = orient2d(axis, a, b, c).
Sign turn2d(Axis axis, const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Returns Positive iff d lies inside the circle through a, b, c (counterclockwise in the
/// projection).
Sign in_circle(Axis axis, const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Whether the three points lie on a line (or coincide).
bool collinear(const Point3& a, const Point3& b, const Point3& c);

/// Returns the axis along which the triangle's normal is longest, the first of z, x, y among equal
/// lengths. The choice is exact, so that parallel triangles get the same axis. The triangle must
/// not be degenerate.
Axis projection_axis(const Point3& a, const Point3& b, const Point3& c);

} // namespace terrane
