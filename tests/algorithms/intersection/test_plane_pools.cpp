// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which sets of coplanar triangles are divided as one, against the rule: connected by coplanar
// candidates, with at least 32 of these per triangle on average.
#include "support/effort.hpp"

#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace {

using namespace terrane;
using namespace test_support;

struct Planes {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    std::vector<CandidatePair> candidates; ///< sorted

    [[nodiscard]] bool are_coplanar(const CandidatePair& p) const {
        const Triangle &t = triangles[p.first], &u = triangles[p.second];
        return std::all_of(u.begin(), u.end(), [&](std::uint32_t v) {
            return orient3d(points[t[0]], points[t[1]], points[t[2]], points[v]) == Sign::Zero;
        });
    }
};

using Engine = std::mt19937;

int below(Engine& random, int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
}

/// Draws triangles in inclined planes, in random order, and chooses pairs of them as candidates.
Planes random_planes(Engine& random) {
    Planes all;
    const int planes = 1 + below(random, 4), triangles = 33 + below(random, 140);
    const int percent = 20 + below(random, 81);
    for (int t = 0; t < triangles; ++t) {
        const int plane = below(random, planes);
        const auto first = static_cast<std::uint32_t>(all.points.size());
        const double at = below(random, 100), next = below(random, 100);
        for (const auto& [x, y] : {std::pair{at, next}, {at + 1, next}, {at, next + 1}})
            all.points.push_back({x, y, 1000.0 * plane + (plane % 2 == 0 ? x + 2 * y : 3 * x)});
        all.triangles.push_back({first, first + 1, first + 2});
    }
    const auto count = static_cast<std::uint32_t>(all.triangles.size());
    for (std::uint32_t t = 0; t < count; ++t)
        for (std::uint32_t u = t + 1; u < count; ++u)
            if (below(random, 100) < percent) all.candidates.push_back({t, u});
    return all;
}

/// Returns the first triangle of the set of each one that is to be divided with others, or no_group.
std::vector<std::uint32_t> expected(const Planes& all) {
    std::vector<std::uint32_t> set(all.triangles.size());
    std::iota(set.begin(), set.end(), 0U);
    std::vector<CandidatePair> coplanar;
    std::ranges::copy_if(all.candidates, std::back_inserter(coplanar),
                         [&](const CandidatePair& p) { return all.are_coplanar(p); });
    for (bool any = true; any;) {
        any = false;
        for (const CandidatePair& p : coplanar) {
            const std::uint32_t least = std::min(set[p.first], set[p.second]);
            any |= set[p.first] != set[p.second];
            set[p.first] = set[p.second] = least;
        }
    }
    std::vector<std::size_t> sizes(set.size(), 0), pairs(set.size(), 0);
    for (const std::uint32_t s : set) ++sizes[s];
    for (const CandidatePair& p : all.candidates)
        if (set[p.first] == set[p.second]) ++pairs[set[p.first]];
    for (std::uint32_t& s : set)
        if (sizes[s] < 2 || 2 * pairs[s] < 32 * sizes[s]) s = no_group;
    return set;
}

bool has_expected_pools(const Planes& all) {
    const PlanePools pools = find_plane_pools({all.points, all.triangles}, all.candidates, {});
    const auto wanted = expected(all);
    for (std::uint32_t t = 0; t < wanted.size(); ++t) {
        const std::uint32_t pool = pools.of.empty() ? no_group : pools.of[t];
        REQUIRE((pool == no_group ? no_group : pools.faces[pool].front()) == wanted[t]);
    }
    return !pools.of.empty();
}

} // namespace

TEST_CASE("pools: sets with 32 coplanar candidates per triangle, and no others", "[intersection]") {
    Engine random(41);
    int with = 0, without = 0;
    for (int k = 0; k < cases(300); ++k)
        ++(has_expected_pools(random_planes(random)) ? with : without);
    CHECK(with > 0);
    CHECK(without > 0);
}

TEST_CASE("pools: 33 triangles that are all candidates of each other are one, 32 are none",
          "[intersection]") {
    for (const std::uint32_t n : {32U, 33U}) {
        Planes all;
        for (std::uint32_t t = 0; t < n; ++t) {
            for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {0., 1.}})
                all.points.push_back({x + t, y, x + t + 2 * y});
            all.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
            for (std::uint32_t u = 0; u < t; ++u) all.candidates.push_back({u, t});
        }
        std::ranges::sort(all.candidates);
        CHECK(has_expected_pools(all) == (n == 33));
    }
}
