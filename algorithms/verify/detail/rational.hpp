// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Exact points and planes of the verifier, as vectors of four integers.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <gmpxx.h>

#include <terrane/kernel/point.hpp>

namespace terrane::verifier {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Homogeneous coordinates of a point or a plane.
/// A point (x, y, z, w) with w > 0 is (x/w, y/w, z/w), in the unit of its model over `scale`.
/// A plane (a, b, c, d) holds the points with a x + b y + c z + d w = 0; its normal is (a, b, c).
/// Both are kept primitive (the four numbers have no common factor), so that equal points are equal
/// vectors.
using Vector4 = std::array<mpz_class, 4>;

/// Returns the vector that is orthogonal to a, b and c.
/// (1) For three points it is the plane through them; zero iff they are collinear. Its normal is
///     on the side from which they are counterclockwise: for (0,0,0), (1,0,0), (0,1,0) the plane
///     is (0,0,1,0).
/// (2) For three planes it is their common point; w = 0 iff they do not have exactly one.
/// (3) For two points and a direction (w = 0) it is the plane that contains all three.
Vector4 orthogonal(const Vector4& a, const Vector4& b, const Vector4& c);

/// Returns zero iff the point lies in the plane, a positive number on the side of the normal.
mpz_class dot(const Vector4& plane, const Vector4& point);

/// Divides a vector by the greatest common factor of its numbers; the sign is kept.
void make_primitive(Vector4& vector);

/// Returns twice the projected area of three points times the product of their w: it is positive
/// iff they are counterclockwise in the projection that drops coordinate `axis` (0, 1, 2; see
/// Axis).
mpz_class turn(const Vector4& a, const Vector4& b, const Vector4& c, std::size_t axis);

/// Returns a coordinate in which the normal of a plane is not zero, so that the projection that
/// drops it is one-to-one on the plane; none iff the normal is zero.
std::optional<std::size_t> projection_axis(const Vector4& plane);

/// Returns the first of the axes on which a normal is longest.
std::size_t longest_axis(const auto& normal) {
    std::size_t axis = 0;
    for (const std::size_t i : {1U, 2U})
        if (abs(normal[i]) > abs(normal[axis])) axis = i;
    return axis;
}

/// Returns the point that a construction defines; none if it is undefined (the line misses the
/// plane, lies in it or has equal points; planes share a line; the lines of line_line are not
/// coplanar). Precondition: its indices are < inputs.size().
std::optional<Vector4> construct(const Construction& construction, std::span<const Vector4> inputs);

/// Points with integer coordinates: doubles times `scale`, the smallest power of two for which all
/// products are integers.
struct ScaledPoints {
    std::vector<Vector4> points; ///< parallel to the doubles; w = 1
    mpz_class scale = 1;
};

/// Scales points to integers. Precondition: all coordinates are finite.
ScaledPoints scale_to_integers(std::span<const Point3> points);

/// Returns the integers nearest to the coordinates of a point, multiplied by a factor; w = 1.
Vector4 rounded_to_integers(const Vector4& point, const mpz_class& factor = 1);

/// Returns the determinant of three points: six times the volume of the tetrahedron that they span with the origin, if
/// w = 1.
mpz_class determinant(const Vector4& a, const Vector4& b, const Vector4& c);

/// A box of doubles that encloses a point; it is used only to skip pairs that cannot touch.
struct Box {
    std::array<double, 3> low;  ///< <= the exact coordinates
    std::array<double, 3> high; ///< >= the exact coordinates
};

Box enclose(const Vector4& point, const mpz_class& scale);

} // namespace terrane::verifier
