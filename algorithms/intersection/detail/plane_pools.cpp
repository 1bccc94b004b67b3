// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds sets of coplanar triangles that overlap many others of the set: dividing their plane once
// costs far less than dividing each triangle by itself.
#include <algorithm>
#include <cmath>
#include <optional>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/kernel/plane_filter.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

/// A pool pays if each of its triangles has at least this many candidates in it, on average. Stacks
/// of a few sheets have fewer, and their triangles are divided one by one.
constexpr std::size_t least_partners = 32;

/// Larger coordinates leave no room for the frame round the pool.
constexpr double most_coordinate = 0x1p900;

class PoolFinder {
public:
    PoolFinder(const TriangleSoup& soup, std::span<const CandidatePair> candidates,
               const Run& run) :
        soup_(soup),
        candidates_(candidates), run_(run) {}

    PlanePools operator()() {
        if (!has_seeds() || !join()) return {};
        return pools();
    }

private:
    [[nodiscard]] const Point3& at(std::uint32_t v) const { return soup_.points[v]; }

    /// Tells whether the static filter alone shows that g is not in the plane of f. It is quick for
    /// pairs with the same f one after the other.
    [[nodiscard]] bool quickly_off_plane(std::uint32_t f, std::uint32_t g) {
        const Triangle &t = soup_.triangles[f], &u = soup_.triangles[g];
        if (f != plane_of_) plane_.emplace(at(t[0]), at(t[1]), at(t[2]));
        plane_of_ = f;
        return std::any_of(u.begin(), u.end(), [&](std::uint32_t v) {
            return v != t[0] && v != t[1] && v != t[2] && plane_->side(at(v)).has_value();
        });
    }

    [[nodiscard]] bool are_coplanar(std::uint32_t f, std::uint32_t g) const {
        const Triangle &t = soup_.triangles[f], &u = soup_.triangles[g];
        return std::all_of(u.begin(), u.end(), [&](std::uint32_t v) {
            if (v == t[0] || v == t[1] || v == t[2]) return true;
            return orient3d(at(t[0]), at(t[1]), at(t[2]), at(v)) == Sign::Zero;
        });
    }

    /// Joins the sets of coplanar triangles of pairs. Returns whether it was not stopped.
    bool join() {
        sets_ = DisjointSets(soup_.triangles.size());
        is_joined_.assign(soup_.triangles.size(), false);
        for (std::size_t k = 0; k < candidates_.size(); ++k) {
            const CandidatePair& p = candidates_[k];
            if (k % 65536 == 0 && run_.stop.stop_requested()) return false;
            if (quickly_off_plane(p.first, p.second) ||
                sets_.find(p.first) == sets_.find(p.second) || !are_coplanar(p.first, p.second))
                continue;
            sets_.join(p.first, p.second);
            is_joined_[p.first] = is_joined_[p.second] = true;
        }
        return true;
    }

    /// Returns for each set the number of candidates within it, under its representative.
    [[nodiscard]] std::vector<std::uint64_t> partners() {
        std::vector<std::uint64_t> pairs(soup_.triangles.size(), 0);
        for (const CandidatePair& p : candidates_) {
            if (!is_joined_[p.first]) continue;
            const std::uint32_t set = sets_.find(p.first);
            if (set == sets_.find(p.second)) ++pairs[set];
        }
        return pairs;
    }

    /// Tells whether some triangle has at least least_partners / 2 coplanar partners after it. Otherwise
    /// there is no pool; for most inputs this is seen quickly.
    bool has_seeds() {
        constexpr std::size_t needed = least_partners / 2; // half of the partners come before it
        for (std::size_t start = 0, end = 0; start < candidates_.size(); start = end) {
            const std::uint32_t f = candidates_[start].first;
            while (end < candidates_.size() && candidates_[end].first == f) ++end;
            std::size_t found = 0;
            for (std::size_t k = start; k < end && found + (end - k) >= needed; ++k) {
                const std::uint32_t g = candidates_[k].second;
                if (quickly_off_plane(f, g) || !are_coplanar(f, g)) continue;
                if (++found == needed) return true;
            }
            if (run_.stop.stop_requested()) return false;
        }
        return false;
    }

    [[nodiscard]] bool has_room(std::uint32_t f) const {
        const Triangle& t = soup_.triangles[f];
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
            const Point3& p = soup_.points[v];
            return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) < most_coordinate;
        });
    }

    [[nodiscard]] PlanePools pools() {
        const auto pairs = partners();
        const auto count = static_cast<std::uint32_t>(soup_.triangles.size());
        std::vector<std::uint32_t> sizes(count, 0);
        std::vector<bool> fits(count, true);
        for (std::uint32_t f = 0; f < count; ++f) {
            ++sizes[sets_.find(f)];
            if (!has_room(f)) fits[sets_.find(f)] = false;
        }
        const auto pays = [&](std::uint32_t set) {
            return fits[set] && sizes[set] > 1 && 2 * pairs[set] >= least_partners * sizes[set];
        };
        PlanePools found;
        std::vector<std::vector<std::uint32_t>> faces;
        std::vector<std::uint32_t> pool_of(count, no_group);
        for (std::uint32_t f = 0; f < count; ++f) {
            const std::uint32_t set = sets_.find(f);
            if (!pays(set)) continue;
            if (pool_of[set] == no_group) {
                pool_of[set] = static_cast<std::uint32_t>(faces.size());
                faces.emplace_back();
            }
            pool_of[f] = pool_of[set];
            faces[pool_of[set]].push_back(f);
        }
        if (faces.empty()) return found;
        found.of = std::move(pool_of);
        for (const auto& list : faces) found.faces.push_back(list);
        return found;
    }

    const TriangleSoup& soup_;
    std::span<const CandidatePair> candidates_;
    const Run& run_;
    DisjointSets sets_{0};
    std::vector<bool> is_joined_; ///< per triangle: whether its set has others
    std::uint32_t plane_of_ = no_index;
    std::optional<PlaneFilter> plane_; ///< of this triangle
};

} // namespace

PlanePools find_plane_pools(const TriangleSoup& soup, std::span<const CandidatePair> candidates,
                            const Run& run) {
    return PoolFinder(soup, candidates, run)();
}

} // namespace terrane
