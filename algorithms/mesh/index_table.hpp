// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/no_index.hpp>

namespace terrane {

/// Finds equal items of a list by their index. It is a hash table with open addressing.
template <class Item, class Hash>
class IndexTable {
public:
    explicit IndexTable(std::size_t expected) : slots_(std::bit_ceil(2 * expected + 2), no_index) {}

    /// Enters item i unless an equal one was entered before. Returns the index of the item in the
    /// table. At most `expected` items may be entered.
    std::uint32_t enter(std::span<const Item> items, std::uint32_t i) {
        std::uint32_t& slot = slots_[slot_of(items, items[i])];
        if (slot == no_index) slot = i;
        return slot;
    }
    /// Returns the index of the equal item that was entered, or no_index.
    [[nodiscard]] std::uint32_t find(std::span<const Item> items, const Item& item) const {
        return slots_[slot_of(items, item)];
    }

private:
    /// Returns the slot of the item, or the free one where it belongs.
    [[nodiscard]] std::size_t slot_of(std::span<const Item> items, const Item& item) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t s = Hash{}(item)&mask;
        while (slots_[s] != no_index && items[slots_[s]] != item) s = (s + 1) & mask;
        return s;
    }

    std::vector<std::uint32_t> slots_;
};

} // namespace terrane
