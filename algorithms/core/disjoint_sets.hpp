// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <terrane/kernel/assertion.hpp>

namespace terrane {

template <class T>
void sort_unique(std::vector<T>& v) {
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
}

/// Union-find; the lowest element stands for its set.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    std::uint32_t find(std::uint32_t i) {
        TERRANE_ASSERT_DEBUG(i < parent_.size());
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        if (parent_[a] == parent_[b]) return; // as mostly, once much is joined
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    /// The element that stands for each set, as long as nothing is joined after.
    const std::vector<std::uint32_t>& flattened() {
        for (std::uint32_t& p : parent_) p = parent_[p]; // never above: already final
        return parent_;
    }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace terrane
