// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Exact coordinates as text.
#pragma once

#include <terrane/kernel/config.hpp>

#include <array>
#include <string>

#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// A reduced fraction in digits of a base: "-5/3", "7", "0"; lower-case letters.
/// (1) Equal numbers give equal texts, and different ones different texts.
/// (2) The denominator is positive, and left out where it is 1.
/// Precondition: denominator != 0, 2 <= base <= 36.
std::string fraction(const Exact& numerator, const Exact& denominator, int base);

/// The three Cartesian coordinates of a stored point, as fractions.
std::array<std::string, 3> fractions(const PointStore& points, PointIndex p, int base);

} // namespace terrane
