// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane::detail {

/// Numbers points in the order of their first use; points with equal coordinates (0 equals -0) get
/// the same number. It is a hash table with open addressing that is at most half full.
class PointNumbering {
public:
    std::uint32_t number(const Point3& point) {
        if (2 * (points_.size() + 1) > slots_.size()) grow();
        auto& slot = find(point);
        if (slot == empty) {
            slot = static_cast<std::uint32_t>(points_.size());
            points_.push_back(point);
        }
        return slot;
    }

    [[nodiscard]] std::vector<Point3> take() { return std::move(points_); }

private:
    static constexpr std::uint32_t empty = UINT32_MAX;

    static std::uint64_t hash(const Point3& p) {
        std::uint64_t h = 0;
        for (const double c : {p.x, p.y, p.z}) {
            h ^= std::bit_cast<std::uint64_t>(c == 0 ? 0.0 : c);
            h *= 0x9E3779B97F4A7C15u;
            h ^= h >> 29;
        }
        return h;
    }

    std::uint32_t& find(const Point3& point) {
        auto i = hash(point) & (slots_.size() - 1);
        while (slots_[i] != empty && points_[slots_[i]] != point) i = (i + 1) & (slots_.size() - 1);
        return slots_[i];
    }

    void grow() {
        slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), empty);
        for (std::uint32_t i = 0; i < points_.size(); ++i) find(points_[i]) = i;
    }

    std::vector<Point3> points_;
    std::vector<std::uint32_t> slots_; ///< indices into points_, or empty; 2^k of them
};

} // namespace terrane::detail
