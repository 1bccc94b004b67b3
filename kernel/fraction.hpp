// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes exact coordinates as text.
#pragma once

#include <terrane/kernel/config.hpp>

#include <array>
#include <string>

#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// Writes a quotient as a reduced fraction in the given base: "-5/3", "7", "0". Digits above 9 are
/// lower-case letters.
/// (1) Two texts are equal iff the numbers are.
/// (2) The denominator is positive and omitted if it is 1.
/// Precondition: denominator != 0, 2 <= base <= 36.
std::string fraction(const Exact& numerator, const Exact& denominator, int base);

/// Writes the three Cartesian coordinates of a stored point as fractions.
std::array<std::string, 3> fractions(const PointStore& points, PointIndex p, int base);

} // namespace terrane
