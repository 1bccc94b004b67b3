// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Distances for the verifier: their squares as fractions of integers.
#pragma once

#include <array>
#include <span>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

using Vector3 = std::array<mpz_class, 3>;

Vector3 difference(const Vector4& a, const Vector4& b); ///< a - w b. Precondition: b has w = 1
Vector3 cross(const Vector3& a, const Vector3& b);
mpz_class dot(const Vector3& a, const Vector3& b);

/// The square of a distance, above / below, in the unit of the points; not reduced.
struct Squared {
    mpz_class above = 0;
    mpz_class below = 1; ///< > 0

    friend bool operator<(const Squared& a, const Squared& b) {
        return a.above * b.below < b.above * a.below;
    }
};

Squared squared_distance(const Vector4& a, const Vector4& b);
/// Precondition: the ends of the segment have w = 1.
Squared squared_distance(const Vector4& point, const Vector4& start, const Vector4& end);
/// Precondition: the corners of the triangle have w = 1. Without area it is its longest side.
Squared squared_distance(const Vector4& point, const std::array<const Vector4*, 3>& triangle);

/// Tells whether the distance is at most `bound`.
bool within(const Squared& distance, const mpz_class& bound);

/// Returns the smallest height of a triangle with area, squared. Precondition: its corners have
/// w = 1.
Squared squared_height(const std::array<const Vector4*, 3>& triangle);

/// Returns a double that is at least the distance over `scale`, and exceeds it by a few units in
/// the last place at most; 0 for 0.
double root_above(const Squared& distance, const mpz_class& scale);

/// Tells whether two points are at most `bound` apart; all numbers have the same scale.
bool within(const Vector4& a, const Vector4& b, const mpz_class& bound);

/// Tells whether a point is at most `bound` away from a segment, whose ends have w = 1.
bool within_of_segment(const Vector4& point, const Vector4& start, const Vector4& end,
                       const mpz_class& bound);

/// Tells whether a point is at most `bound` away from a (closed) triangle, whose corners have w =
/// 1.
bool within(const Vector4& point, const std::array<const Vector4*, 3>& triangle,
            const mpz_class& bound);

/// Tells whether each point of a segment is shown to be at most `bound` away from some triangle.
/// The distance to one triangle is convex, so a piece of the segment is near it if both its ends
/// are. The segment is divided at the corners of triangles that are near it, and pieces are halved
/// where one triangle takes over from another.
/// Precondition: all points have w = 1, and the ends of the segment differ.
bool segment_is_near(const std::array<const Vector4*, 2>& segment, std::span<const Vector4> points,
                     std::span<const Triangle> triangles, const mpz_class& bound);

} // namespace terrane::verifier
