// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds sets of coplanar triangles of which so many overlap that dividing each by itself would
// cost far more than dividing their plane once.
#include <algorithm>
#include <cmath>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

/// A pool pays if its triangles have so many candidates among themselves, on average. Stacks of a
/// few sheets have fewer, and their triangles are divided one by one as ever.
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
        if (!has_seeds()) return {};
        if (!join([](const CandidatePair&) { return true; })) return {};
        return pools();
    }

private:
    [[nodiscard]] bool are_coplanar(std::uint32_t f, std::uint32_t g) const {
        const Triangle &t = soup_.triangles[f], &u = soup_.triangles[g];
        const auto at = [&](std::uint32_t v) -> const Point3& { return soup_.points[v]; };
        return std::all_of(u.begin(), u.end(), [&](std::uint32_t v) {
            if (v == t[0] || v == t[1] || v == t[2]) return true;
            return orient3d(at(t[0]), at(t[1]), at(t[2]), at(v)) == Sign::Zero;
        });
    }

    /// Joins the sets of coplanar triangles of pairs. Returns whether it was not stopped.
    template <class Takes>
    bool join(const Takes& takes) {
        for (std::size_t k = 0; k < candidates_.size(); ++k) {
            const CandidatePair& p = candidates_[k];
            if (k % 65536 == 0 && run_.stop.stop_requested()) return false;
            if (takes(p) && sets_.find(p.first) != sets_.find(p.second) &&
                are_coplanar(p.first, p.second))
                sets_.join(p.first, p.second);
        }
        return true;
    }

    /// Returns for each set the number of candidates within it, under its representative.
    [[nodiscard]] std::vector<std::uint64_t> partners() {
        std::vector<std::uint64_t> pairs(soup_.triangles.size(), 0);
        for (const CandidatePair& p : candidates_) {
            const std::uint32_t set = sets_.find(p.first);
            if (set == sets_.find(p.second)) ++pairs[set];
        }
        return pairs;
    }

    /// Joins triangles with many candidates only. Returns whether one of the sets may be a pool.
    /// This is quick for most inputs, which have none.
    bool has_seeds() {
        if (candidates_.size() < least_partners * least_partners / 2) return false;
        std::vector<std::uint32_t> degrees(soup_.triangles.size(), 0);
        std::uint32_t most = 0;
        for (const CandidatePair& p : candidates_)
            for (const std::uint32_t f : {p.first, p.second}) most = std::max(most, ++degrees[f]);
        if (most < least_partners) return false;
        sets_ = DisjointSets(soup_.triangles.size());
        const auto is_busy = [&](std::uint32_t f) { return degrees[f] >= least_partners / 2; };
        if (!join([&](const CandidatePair& p) { return is_busy(p.first) && is_busy(p.second); }))
            return false;
        const auto pairs = partners();
        return std::any_of(pairs.begin(), pairs.end(), [](std::uint64_t n) {
            return n >= least_partners * least_partners / 4;
        });
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
};

} // namespace

PlanePools find_plane_pools(const TriangleSoup& soup, std::span<const CandidatePair> candidates,
                            const Run& run) {
    return PoolFinder(soup, candidates, run)();
}

} // namespace terrane
