// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace terrane {

/// Many short lists in two flat arrays: list i is values[offsets[i], offsets[i + 1]).
template <class T>
struct IndexLists {
    std::vector<std::uint32_t> offsets; ///< size() + 1, ascending from 0
    std::vector<T> values;              ///< all lists, one after the other

    // A default member initialiser would do, but then gcc 12 frees the offsets twice when a later
    // member of an aggregate finds no memory.
    IndexLists() : offsets(1) {}
    /// Returns the number of lists.
    [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
    /// Returns list i.
    [[nodiscard]] std::span<const T> operator[](std::size_t i) const {
        return {values.data() + offsets[i], values.data() + offsets[i + 1]};
    }
    /// Ends the current list, which holds the values added to `values` since the last call.
    void close() { offsets.push_back(static_cast<std::uint32_t>(values.size())); }
    /// Appends a list.
    void push_back(std::span<const T> list) {
        values.insert(values.end(), list.begin(), list.end());
        close();
    }
    /// Appends all lists of `other`.
    void append(const IndexLists& other) {
        const auto start = static_cast<std::uint32_t>(values.size());
        values.insert(values.end(), other.values.begin(), other.values.end());
        for (std::size_t i = 1; i < other.offsets.size(); ++i)
            offsets.push_back(start + other.offsets[i]);
    }
    friend bool operator==(const IndexLists&, const IndexLists&) = default;
};

/// Returns `count` lists. List k holds value_of(i) for each i with keys[i] == k, sorted by i. Every
/// key must be below `count`. The function calls value_of once for each i, in ascending order. Cost:
/// linear.
template <class T, class ValueOf>
IndexLists<T> lists_by_key(std::size_t count, std::span<const std::uint32_t> keys,
                           ValueOf value_of) {
    IndexLists<T> lists;
    lists.offsets.assign(count + 1, 0);
    for (const std::uint32_t k : keys) ++lists.offsets[k + 1];
    std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
    lists.values.resize(keys.size());
    std::vector<std::uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for (std::size_t i = 0; i < keys.size(); ++i) lists.values[next[keys[i]]++] = value_of(i);
    return lists;
}

} // namespace terrane
