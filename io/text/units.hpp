// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Units of length: their names in files, and conversion.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

/// Returns the one name for a unit of length that files spell in several ways: "m" for metre,
/// meters, M; "ft", "ftUS", "km", "cm". Other text is returned as it is, without blanks around it.
std::string unit_named(std::string_view text);

/// Returns the length of a unit in metres. Source: 1 ft = 0.3048 m and 1 ftUS = 1200/3937 m (NIST
/// Special Publication 811, appendix B).
std::optional<double> metres_in(std::string_view unit);

/// Converts what has a stated unit and states the new one. Errors: bad_option for a unit that is
/// not known; unsupported if the file states such a one; bad_number if a coordinate overflows.
MaybeError convert_units(Surface& surface, std::string_view unit);

/// Returns the unit of x, y and z that the files of the surfaces state; empty if none does, or if
/// two of them differ.
std::string common_unit(std::span<const Surface> surfaces);

} // namespace terrane::detail
