// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/quantities.hpp>

#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace terrane::cli {
namespace {

/// The least lengths, areas and volumes in metres that are written in kilometres.
constexpr std::array<double, 4> least_in_kilometres{0, 1e4, 1e5, 1e8};

std::string powered(const std::string& unit, int dimension) {
    return dimension == 1 ? unit : unit + std::to_string(dimension);
}

} // namespace

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
    const bool far =
        unit_ == "m" && std::abs(value) >= least_in_kilometres[static_cast<std::size_t>(dimension)];
    return fmt::format("{} {}", figure(far ? value / std::pow(1000.0, dimension) : value, digits),
                       powered(far ? "km" : unit_, dimension));
}

} // namespace terrane::cli
