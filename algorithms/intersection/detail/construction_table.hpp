// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::intersection::detail {

/// Assigns an index to each distinct construction. Input points keep their indices; the others are
/// numbered from `first`.
class ConstructionTable {
public:
    explicit ConstructionTable(PointIndex first) : first_(first), slots_(64, none) {}

    /// Makes room for `count` constructions.
    void reserve(std::size_t count) {
        constructions_.reserve(count);
        if (2 * count > slots_.size()) resize(std::bit_ceil(2 * count));
    }

    /// Returns the index of a construction, which is added if it is new.
    PointIndex enter(const Construction& how) {
        if (how.kind == Construction::Kind::input) return how.v[0];
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t s = hash(how) & mask;; s = (s + 1) & mask) {
            if (slots_[s] == none) return add(s, how);
            if (constructions_[slots_[s]] == how) return first_ + slots_[s];
        }
    }

    [[nodiscard]] std::span<const Construction> constructions() const { return constructions_; }

private:
    static constexpr std::uint32_t none = UINT32_MAX;

    static std::size_t hash(const Construction& how) {
        std::uint64_t h = static_cast<std::uint64_t>(how.kind);
        for (const std::uint32_t v : how.v) h = std::rotl((h ^ v) * 0x9e3779b97f4a7c15u, 29);
        return h ^ (h >> 32);
    }

    PointIndex add(std::size_t slot, const Construction& how) {
        const auto k = static_cast<std::uint32_t>(constructions_.size());
        slots_[slot] = k;
        constructions_.push_back(how);
        if (2 * constructions_.size() > slots_.size()) resize(2 * slots_.size());
        return first_ + k;
    }

    void resize(std::size_t slots) {
        slots_.assign(slots, none);
        for (std::uint32_t k = 0; k < constructions_.size(); ++k) {
            std::size_t s = hash(constructions_[k]) & (slots_.size() - 1);
            while (slots_[s] != none) s = (s + 1) & (slots_.size() - 1);
            slots_[s] = k;
        }
    }

    PointIndex first_;
    std::vector<Construction> constructions_;
    std::vector<std::uint32_t> slots_;
};

} // namespace terrane::intersection::detail
