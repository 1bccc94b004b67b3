// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

#include <terrane/algorithms/mesh/index_table.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// Hashes the coordinates of a point; -0 hashes like 0.
inline std::uint64_t hash_of(const Point3& p) {
    const auto mix = [](std::uint64_t h, double d) {
        h = (h ^ std::bit_cast<std::uint64_t>(d + 0.0)) * 0x9e3779b97f4a7c15u;
        return h ^ (h >> 29);
    };
    const std::uint64_t h = mix(mix(mix(0, p.x), p.y), p.z);
    const std::uint64_t once_more = (h ^ (h >> 32)) * 0x9e3779b97f4a7c15u;
    return once_more ^ (once_more >> 29);
}

struct PointHash {
    std::size_t operator()(const Point3& p) const { return hash_of(p); }
};

/// Finds points with equal coordinates.
using PointTable = IndexTable<Point3, PointHash>;

} // namespace terrane
