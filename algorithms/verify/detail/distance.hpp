// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Distances for the verifier, compared with a bound in integers.
#pragma once

#include <array>

#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

using Vector3 = std::array<mpz_class, 3>;

Vector3 difference(const Vector4& a, const Vector4& b); ///< a - w b. Precondition: b has w = 1
Vector3 cross(const Vector3& a, const Vector3& b);
mpz_class dot(const Vector3& a, const Vector3& b);

/// Tells whether two points are at most `bound` apart; all numbers have the same scale.
bool within(const Vector4& a, const Vector4& b, const mpz_class& bound);

/// Tells whether a point is at most `bound` away from a segment, whose ends have w = 1.
bool within_of_segment(const Vector4& point, const Vector4& start, const Vector4& end,
                       const mpz_class& bound);

/// Tells whether a point is at most `bound` away from a (closed) triangle, whose corners have w =
/// 1.
/// Precondition: the triangle has area.
bool within(const Vector4& point, const std::array<const Vector4*, 3>& triangle,
            const mpz_class& bound);

} // namespace terrane::verifier
