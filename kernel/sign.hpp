// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace terrane {

/// The sign of an exact real number. An undecided sign is an empty std::optional<Sign>, never Zero.
enum class Sign : std::int8_t { Negative = -1, Zero = 0, Positive = 1 };

constexpr Sign operator-(Sign s) {
    return static_cast<Sign>(-static_cast<int>(s));
}
constexpr Sign operator*(Sign a, Sign b) {
    return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b));
}

/// Returns the sign of a number that compares with 0 exactly.
template <class N>
constexpr Sign sign_of(const N& value) {
    if (value > 0) return Sign::Positive;
    return value < 0 ? Sign::Negative : Sign::Zero;
}

} // namespace terrane
