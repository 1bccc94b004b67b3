// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The verifier's own disjoint sets.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace terrane::verifier {

/// Disjoint sets of the numbers below a count; the lowest element of a set represents it.
class JoinedSets {
public:
    explicit JoinedSets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0U); }

    std::uint32_t find(std::uint32_t x) {
        while (up_[x] != x) x = up_[x] = up_[up_[x]];
        return x;
    }
    void join(std::uint32_t x, std::uint32_t y) {
        x = find(x);
        y = find(y);
        up_[std::max(x, y)] = std::min(x, y);
    }

private:
    std::vector<std::uint32_t> up_;
};

} // namespace terrane::verifier
