// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines conditions for assertions on lists. Each costs one pass over the list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <terrane/algorithms/core/index_lists.hpp>

namespace terrane {

/// Whether each value is less than the next one.
template <class List>
bool is_sorted_unique(const List& list) {
    return std::adjacent_find(list.begin(), list.end(),
                              [](const auto& a, const auto& b) { return !(a < b); }) == list.end();
}

/// Whether all indices are less than `end`.
template <class List>
bool all_below(const List& indices, std::size_t end) {
    return std::all_of(indices.begin(), indices.end(), [&](std::size_t i) { return i < end; });
}

/// Whether the corners of all cells are less than `end`.
template <class Cells>
bool corners_below(const Cells& cells, std::size_t end) {
    return std::all_of(cells.begin(), cells.end(),
                       [&](const auto& cell) { return all_below(cell, end); });
}

/// Whether offsets ascend from 0 to the number of values.
template <class T>
bool has_valid_offsets(const IndexLists<T>& lists) {
    return !lists.offsets.empty() && lists.offsets.front() == 0 &&
           lists.offsets.back() == lists.values.size() &&
           std::is_sorted(lists.offsets.begin(), lists.offsets.end());
}

/// Whether there are `count` lists, each of them sorted, unique and not empty.
template <class T>
bool are_sorted_lists(const IndexLists<T>& lists, std::size_t count) {
    if (!has_valid_offsets(lists) || lists.size() != count) return false;
    for (std::size_t i = 0; i < count; ++i)
        if (lists[i].empty() || !is_sorted_unique(lists[i])) return false;
    return true;
}

} // namespace terrane
