// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>

namespace terrane::detail {

/// Returns the number whose bytes begin at `bytes`, in the given byte order.
template <class T>
[[nodiscard]] T load(const char* bytes, std::endian order = std::endian::little) {
    std::array<char, sizeof(T)> copy;
    std::memcpy(copy.data(), bytes, sizeof(T));
    if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
    return std::bit_cast<T>(copy);
}

/// Appends the bytes of a number, little endian.
template <class T>
void store(std::string& out, T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (std::endian::native != std::endian::little) std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
}

} // namespace terrane::detail
