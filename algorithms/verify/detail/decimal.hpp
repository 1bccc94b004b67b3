// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace terrane::verifier {

/// Returns the number that a text is the shortest decimal of; none for any other text, also for
/// another decimal of the same number.
template <class Real>
std::optional<Real> shortest_decimal(std::string_view text) {
    Real value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    std::array<char, 64> shortest{};
    const auto [last, failed] =
        std::to_chars(shortest.data(), shortest.data() + shortest.size(), value);
    if (failed != std::errc() ||
        text != std::string_view(shortest.data(), static_cast<std::size_t>(last - shortest.data())))
        return std::nullopt;
    return value;
}

} // namespace terrane::verifier
