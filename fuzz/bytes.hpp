// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace terrane::fuzz {

/// Reads small numbers from the bytes of a fuzzer, from the front and one byte each, so that a
/// changed byte changes one number; after the last byte they are zero. (FuzzedDataProvider of clang
/// takes bytes from the back, and other compilers do not have it.)
class Bytes {
public:
    Bytes(const std::uint8_t* bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}

    [[nodiscard]] bool empty() const { return next_ == end_; }

    unsigned byte() { return empty() ? 0 : *next_++; }

    bool flag() { return (byte() & 1) != 0; }

    /// Returns a number in [0, count); count <= 256.
    unsigned below(unsigned count) { return byte() % count; }

    /// Returns a number in [low, high], which has at most 256 numbers.
    int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<unsigned>(high - low + 1)));
    }

    /// Returns any double, from eight bytes, including NaN and infinities.
    double any_double() {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }

private:
    const std::uint8_t* next_;
    const std::uint8_t* end_;
};

} // namespace terrane::fuzz
