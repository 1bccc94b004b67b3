// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace terrane {

/// A position that is sorted by a key.
struct Keyed {
    std::uint32_t key, position;
};

/// Sorts stably by key, with one pass per digit of 11 bits. `scratch` keeps its memory for the next
/// call. Cost: linear, plus 2048 steps per digit of the largest key.
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
