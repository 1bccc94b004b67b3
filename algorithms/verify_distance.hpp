// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Internal to the verifier: distances compared with a bound, by integers.
#pragma once

#include <array>

#include <terrane/algorithms/verify_rational.hpp>

namespace terrane::verifier {

/// Whether two points are at most `bound` apart; all in one scale.
bool within(const Vector4& a, const Vector4& b, const mpz_class& bound);

/// Whether a point is at most `bound` away from a triangle, a closed set. All have w = 1.
/// Precondition: the triangle has area.
bool within(const Vector4& point, const std::array<const Vector4*, 3>& triangle,
            const mpz_class& bound);

} // namespace terrane::verifier
