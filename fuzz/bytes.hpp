// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace terrane::fuzz {

/// Small numbers from a fuzzer's bytes, one byte each and from the front, so that a changed byte
/// changes one number; zeros once the bytes are used up. (clang's FuzzedDataProvider takes them
/// from the back, and other compilers do not have it.)
class Bytes {
public:
    Bytes(const std::uint8_t* bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}

    [[nodiscard]] bool empty() const { return next_ == end_; }

    unsigned byte() { return empty() ? 0 : *next_++; }

    bool flag() { return (byte() & 1) != 0; }

    /// In [0, count); count <= 256.
    unsigned below(unsigned count) { return byte() % count; }

    /// In [low, high], which holds at most 256 numbers.
    int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<unsigned>(high - low + 1)));
    }

    /// Any of eight bytes, not a number and infinite ones too.
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
