// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How far a node that was put on a triangle, or on an edge of one, may be from it. The allowance
// depends on the input triangle only: it is a number of spacings of the doubles at its coordinates.
// A point of a triangle that is rounded to doubles is off by half a spacing in each coordinate; one
// that is computed in doubles from the corners, by at most five (statement (1) in
// docs/explanation/tetrahedra.md).
#pragma once

#include <array>

#include <terrane/kernel/point.hpp>

namespace terrane::tetrahedra {

constexpr double allowed_spacings = 5;

/// What reach and volume_within_reach add of themselves, so that rounding makes neither too small.
/// kernel/proofs/allowance.g is a proof that Gappa checks with this number.
constexpr double rounding_room = 0x1p-40;

/// The distance between the doubles in the binade of x, at least that of the denormals.
double spacing_at(double x);

/// An edge of a triangle, or a triangle: the allowance in each coordinate.
Point3 allowance(const Point3& a, const Point3& b);
Point3 allowance(const std::array<Point3, 3>& triangle);

/// Whether a point of the edge a b differs from p by no more than the allowance in each coordinate.
/// Exact.
bool near_edge(const Point3& p, const Point3& a, const Point3& b);

/// Whether a point of the triangle's plane differs from p by no more than the allowance in each
/// coordinate. Exact. The triangle must have an area.
bool near_plane(const Point3& p, const std::array<Point3, 3>& triangle);

/// An upper bound of the distance from a triangle of all points of faces that cover it, by
/// statement (5).
double reach(const std::array<Point3, 3>& triangle);

/// An upper bound of the volume of all points that are no farther from the triangle than its reach.
double volume_within_reach(const std::array<Point3, 3>& triangle);

} // namespace terrane::tetrahedra
