// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/figure.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include <fmt/format.h>

namespace terrane {
namespace {

constexpr int most_digits = 6;
constexpr int least_power = -4, end_of_powers = 15; ///< of ten, without an exponent
constexpr int least_grouped = 6;                    ///< power of ten

std::string without_zeros(std::string text) {
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string fixed(double value, int decimals) {
    return without_zeros(fmt::format("{:.{}f}", value, decimals));
}

std::string grouped(std::string text) {
    const auto first = static_cast<std::size_t>(text.front() == '-' ? 1 : 0);
    for (auto at = text.size(); at > first + 3;) text.insert(at -= 3, 1, ',');
    return text;
}

} // namespace

std::string figure(double value, int digits) {
    if (std::isnan(value)) return "?";
    if (std::isinf(value)) return value > 0 ? "> 1.8e308" : "< -1.8e308";
    if (value == 0) return "0";
    // The rounded number decides: 999 999.7 is a million.
    digits = std::clamp(digits, 1, most_digits);
    const auto scientific = fmt::format("{:.{}e}", value, digits - 1);
    const auto e = scientific.find('e');
    const int power = std::atoi(scientific.c_str() + e + 1);
    if (power < least_power || power >= end_of_powers)
        return fmt::format("{}e{}", without_zeros(scientific.substr(0, e)), power);
    if (power < digits) return fixed(value, digits - 1 - power);
    std::string text = scientific.substr(0, e);
    std::erase(text, '.');
    text.append(static_cast<std::size_t>(power + 1 - digits), '0');
    return power < least_grouped ? text : grouped(text);
}

std::string place_text(std::initializer_list<double> coordinates, double extent) {
    constexpr double far = 1000;                                   // extents from the origin
    constexpr double least_extent = 1e-12, most_coordinate = 1e15; // written without exponents
    if (!(extent > 0))
        for (const double c : coordinates) extent = std::max(extent, std::abs(c) / far);
    const double power = std::floor(std::log10(std::min(extent, most_coordinate)));
    std::string text;
    for (const double c : coordinates) {
        text += text.empty() ? "(" : ", ";
        text += extent >= least_extent && std::abs(c) < most_coordinate
                    ? fixed(c, std::max(most_digits - 1 - static_cast<int>(power), 0))
                    : figure(c);
    }
    return text + ")";
}

std::string place_text(const Point3& place, double extent) {
    return place_text({place.x, place.y, place.z}, extent);
}

double extent_of(std::span<const Point3> places) {
    if (places.empty()) return 0;
    const auto side = [&](double Point3::*axis) {
        const auto [least, most] = std::ranges::minmax(places, {}, axis);
        return most.*axis - least.*axis;
    };
    return std::max({side(&Point3::x), side(&Point3::y), side(&Point3::z)});
}

} // namespace terrane
