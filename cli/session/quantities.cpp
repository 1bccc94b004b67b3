// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/quantities.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace terrane::cli {
namespace {

/// The least lengths, areas and volumes in metres that are written in kilometres.
constexpr std::array<double, 4> least_in_kilometres{0, 1e4, 1e5, 1e8};

/// Returns the digits by which a number below ten millions is written without an exponent.
int digits_without_exponent(double value, int digits) {
    constexpr double most = 1e7;
    const double size = std::abs(value);
    if (!(size >= 1 && size < most)) return digits;
    return std::max(digits, static_cast<int>(std::log10(size)) + 1);
}

std::string powered(const std::string& unit, int dimension) {
    return dimension == 1 ? unit : unit + std::to_string(dimension);
}

} // namespace

std::string figure(double value, int digits) {
    if (std::isnan(value)) return "?";
    if (std::isinf(value)) return value > 0 ? "> 1.8e308" : "< -1.8e308";
    return fmt::format("{:.{}g}", value, digits);
}

std::string Quantities::length(double value, int digits) const {
    return with_unit(value, digits, 1);
}

std::string Quantities::lengths(double from, double to, int digits) const {
    const bool far = unit_ == "m" && std::abs(to) >= least_in_kilometres[1];
    const double scale = far ? 1e-3 : 1;
    return fmt::format("{} to {}{}", figure(from * scale, digits), figure(to * scale, digits),
                       unit_.empty() ? ""
                       : far         ? " km"
                                     : " " + unit_);
}

std::string Quantities::area(double value, int digits) const {
    return with_unit(value, digits, 2);
}

std::string Quantities::volume(double value, int digits) const {
    return with_unit(value, digits, 3);
}

std::string Quantities::with_unit(double value, int digits, int dimension) const {
    if (unit_.empty() || !std::isfinite(value)) return figure(value, digits);
    if (unit_ != "m" || std::abs(value) < least_in_kilometres[static_cast<std::size_t>(dimension)])
        return fmt::format("{:.{}g} {}", value, digits_without_exponent(value, digits),
                           powered(unit_, dimension));
    return fmt::format("{:.{}g} {}", value / std::pow(1000.0, dimension), digits,
                       powered("km", dimension));
}

} // namespace terrane::cli
