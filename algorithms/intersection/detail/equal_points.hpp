// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Merges equal constructed points as they come, so that n surfaces through one point cost the
// memory of one point, not of n^2 constructions.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::intersection::detail {

/// Distinct points of a store by their nearest doubles. Equal points have equal nearest doubles, so
/// only points with the same ones are compared exactly.
class EqualPoints {
public:
    explicit EqualPoints(const PointStore& store) : store_(store), slots_(64, none) {}

    /// Makes room for `count` points.
    void reserve(std::size_t count) {
        if (2 * count > slots_.size()) rebuild(std::bit_ceil(2 * count));
    }

    /// Returns the slot of the point that has been entered and is equal to p, or of p, which is
    /// then entered; the caller may store another name of that point there. Returns nullptr if so
    /// many unequal points have the same nearest doubles that the search was given up.
    PointIndex* enter(PointIndex p) {
        if (2 * count_ >= slots_.size()) rebuild(2 * slots_.size());
        const std::size_t mask = slots_.size() - 1;
        unsigned tries = 0;
        for (std::size_t s = hash(store_.nearest(p)) & mask;; s = (s + 1) & mask) {
            if (slots_[s] == none) {
                ++count_;
                slots_[s] = p;
                return &slots_[s];
            }
            if (store_.nearest(slots_[s]) != store_.nearest(p)) continue;
            if (store_.equal(slots_[s], p)) return &slots_[s];
            if (++tries == most_tries) return nullptr;
        }
    }

private:
    static constexpr PointIndex none = UINT32_MAX;
    static constexpr unsigned most_tries = 8; // exact comparisons

    static std::size_t hash(const Point3& p) {
        std::uint64_t h = 0;
        for (const double x : {p.x, p.y, p.z}) // adding 0.0 turns -0 into 0, which is equal
            h = std::rotl((h ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15u, 29);
        return h ^ (h >> 32);
    }

    void rebuild(std::size_t size) {
        std::vector<PointIndex> old(size, none);
        old.swap(slots_);
        const std::size_t mask = slots_.size() - 1;
        for (const PointIndex p : old) {
            if (p == none) continue;
            std::size_t s = hash(store_.nearest(p)) & mask;
            while (slots_[s] != none) s = (s + 1) & mask;
            slots_[s] = p;
        }
    }

    const PointStore& store_;
    std::vector<PointIndex> slots_;
    std::size_t count_ = 0;
};

} // namespace terrane::intersection::detail
