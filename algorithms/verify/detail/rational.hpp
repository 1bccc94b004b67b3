// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Internal to the verifier: exact points and planes as vectors of four integers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <gmpxx.h>

#include <terrane/kernel/construction.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::verifier {

/// Homogeneous coordinates.
/// A point (x, y, z, w) with w > 0 is (x/w, y/w, z/w), in the unit of its model over `scale`.
/// A plane (a, b, c, d) holds the points with a x + b y + c z + d w = 0; its normal is (a, b, c).
/// Both are kept primitive (the four have no common factor): equal points are equal vectors.
using Vector4 = std::array<mpz_class, 4>;

/// The vector that is orthogonal to a, b and c.
/// (1) Of three points: the plane through them, zero iff they are collinear. The normal points to
///     where the three are seen counterclockwise: of (0,0,0), (1,0,0), (0,1,0) it is (0,0,1,0).
/// (2) Of three planes: the point they share; w = 0 iff they do not share exactly one point.
/// (3) Of two points and a direction (w = 0): the plane that holds all three.
Vector4 orthogonal(const Vector4& a, const Vector4& b, const Vector4& c);

/// Zero iff the point lies in the plane; positive on the side that the normal points to.
mpz_class dot(const Vector4& plane, const Vector4& point);

/// Divides by the greatest common factor; the sign stays.
void make_primitive(Vector4& vector);

/// Twice the projected area of three points, times the product of their w: positive iff they are
/// counterclockwise in the projection that drops coordinate `axis` (0, 1, 2; see Axis).
mpz_class turn(const Vector4& a, const Vector4& b, const Vector4& c, std::size_t axis);

/// A coordinate in which the plane's normal is not zero: along it, the plane projects one-to-one.
/// None iff the normal is zero.
std::optional<std::size_t> projection_axis(const Vector4& plane);

/// The point that a construction names; none where it is undefined (the line misses the plane, lies
/// in it or is no line; planes share a line; the two lines of line_line are not coplanar).
/// Precondition: its indices are < inputs.size().
std::optional<Vector4> construct(const Construction& construction, std::span<const Vector4> inputs);

/// Points with integer coordinates: the doubles times `scale`, the smallest power of two that does.
struct ScaledPoints {
    std::vector<Vector4> points; ///< parallel to the doubles; w = 1
    mpz_class scale = 1;
};

/// Precondition: all coordinates are finite.
ScaledPoints scale_to_integers(std::span<const Point3> points);

/// Doubles that enclose a point; only ever used to skip what can't touch.
struct Box {
    std::array<double, 3> low;  ///< <= the exact coordinates
    std::array<double, 3> high; ///< >= the exact coordinates
};

Box enclose(const Vector4& point, const mpz_class& scale);

} // namespace terrane::verifier
