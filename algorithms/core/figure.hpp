// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Numbers for people: on the terminal, in report pages and in messages. Files keep all digits.
#pragma once

#include <initializer_list>
#include <span>
#include <string>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// Writes a number with at most `digits` significant digits, 6 at most; zeros at the end of a
/// fraction are left out.
/// (1) From 0.0001 to 10^15 there is no exponent: "123500", never "1.235e+05".
/// (2) From a million on, commas group three digits: "12,345,700".
/// (3) Beyond, the exponent has no zero in front: "3.7e-12".
/// (4) NaN is "?", an infinite number is "> 1.8e308" or "< -1.8e308".
std::string figure(double value, int digits = 6);

/// Writes a place as "(1.5, 2, -300.25)", without groups, so that other programs take it. A
/// coordinate has the decimals that 6 significant digits of the model's extent need. Without
/// an extent, 9 digits of the largest coordinate are written: as good, up to a thousand extents
/// from the origin.
std::string place_text(const Point3& place, double extent = 0);
std::string place_text(std::initializer_list<double> coordinates, double extent = 0);

/// Returns the longest side of the box around all places, or 0 without any.
double extent_of(std::span<const Point3> places);

} // namespace terrane
