// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

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

/// Finds points with equal coordinates. It is a hash table with open addressing.
class PointTable {
public:
    explicit PointTable(std::size_t expected) : slots_(std::bit_ceil(2 * expected + 2), none) {}

    /// Enters point v unless a point with equal coordinates was entered before. Returns the index
    /// of the point in the table. At most `expected` points may be entered.
    std::uint32_t enter(std::span<const Point3> points, std::uint32_t v) {
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t s = hash_of(points[v]) & mask;; s = (s + 1) & mask) {
            if (slots_[s] == none) return slots_[s] = v;
            if (points[slots_[s]] == points[v]) return slots_[s];
        }
    }

    /// Returns the index of the entered point with these coordinates, or UINT32_MAX.
    [[nodiscard]] std::uint32_t find(std::span<const Point3> points, const Point3& p) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t s = hash_of(p) & mask;
        while (slots_[s] != none && points[slots_[s]] != p) s = (s + 1) & mask;
        return slots_[s];
    }

private:
    static constexpr std::uint32_t none = UINT32_MAX;

    std::vector<std::uint32_t> slots_;
};

} // namespace terrane
