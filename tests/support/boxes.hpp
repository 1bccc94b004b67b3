// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Boxes for tests of the search.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/search/search.hpp>

namespace box_cases {

using namespace terrane;

using Groups = std::vector<std::uint32_t>;

inline bool meet(const Box& a, const Box& b) {
    for (unsigned k = 0; k < 3; ++k)
        if (std::max(a.low[k], b.low[k]) > std::min(a.high[k], b.high[k])) return false;
    return true;
}

inline Box box(const Point3& p, const Point3& size) {
    return {{p.x, p.y, p.z}, {p.x + size.x, p.y + size.y, p.z + size.z}};
}

} // namespace box_cases
