// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstring>
#include <vector>

#include <terrane/algorithms/tiles/supersteps.hpp>

namespace terrane::tiles::detail {

/// Lets add(tile, sum) add what each tile has to a sum, in order, and returns the sum in all processes.
template <class Sum, class Add>
Result<Sum> over_tiles(Supersteps& tiles, const Add& add) {
    const auto bytes = tiles.relay([&](Tile& b, Bytes before) {
        Sum sum{};
        if (!before.empty()) std::memcpy(&sum, before.data(), sizeof sum);
        add(b, sum);
        Bytes next;
        append_record(next, sum);
        return next;
    });
    if (!bytes) return bytes.error();
    Sum sum{};
    std::memcpy(&sum, bytes->data(), sizeof sum);
    return sum;
}

/// Tells all processes an array that the process of the first tile has.
template <class T>
Status tell_all(Supersteps& tiles, std::vector<T>& array) {
    const auto bytes = tiles.relay([&](Tile& b, Bytes before) {
        if (b.index == 0)
            for (const T& record : array) append_record(before, record);
        return before;
    });
    if (!bytes) return bytes.error();
    array.resize(bytes->size() / sizeof(T));
    if (!array.empty()) std::memcpy(array.data(), bytes->data(), bytes->size());
    return Done{};
}

} // namespace terrane::tiles::detail
