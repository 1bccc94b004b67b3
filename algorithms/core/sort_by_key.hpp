// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace terrane {

/// A position and the key by which it is sorted.
struct Keyed {
    std::uint32_t key, position;
};

/// Sorts items stably by key: a radix sort with digits of 11 bits. A caller that sorts often passes
/// the same `scratch` each time, so that no memory is allocated again. Each digit of the largest key
/// costs one step per item and 2048 more.
inline void sort_by_key(std::vector<Keyed>& items, std::vector<Keyed>& scratch) {
    constexpr unsigned bits = 11;
    constexpr std::uint32_t digits = 1u << bits;
    std::uint32_t all = 0;
    for (const Keyed& i : items) all |= i.key;
    scratch.resize(items.size());
    for (unsigned shift = 0; shift < 32 && all >> shift != 0; shift += bits) {
        std::array<std::uint32_t, digits> next{};
        for (const Keyed& i : items) ++next[(i.key >> shift) % digits];
        std::uint32_t sum = 0;
        for (std::uint32_t& n : next) n = std::exchange(sum, sum + n);
        for (const Keyed& i : items) scratch[next[(i.key >> shift) % digits]++] = i;
        items.swap(scratch);
    }
}

} // namespace terrane
