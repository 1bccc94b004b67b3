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

/// Union-find over 0 .. n - 1. The lowest element represents its set.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    /// Returns the representative of the set of i.
    std::uint32_t find(std::uint32_t i) {
        TERRANE_ASSERT_DEBUG(i < parent_.size());
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        if (parent_[a] == parent_[b]) return; // the usual case once most sets are joined
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    /// Returns the representative of each element; valid until the next join.
    const std::vector<std::uint32_t>& flattened() {
        for (std::uint32_t& p : parent_) p = parent_[p]; // parents are lower, so already final
        return parent_;
    }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace terrane
