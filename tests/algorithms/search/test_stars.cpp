// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the search at crowded vertices with a test of every pair.
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace {

using namespace terrane;
using namespace test_support;
using Pairs = std::vector<CandidatePair>;

struct Fans {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;

    std::uint32_t vertex(const Point3& p) {
        const auto found = std::find(points.begin(), points.end(), p) - points.begin();
        const auto at = static_cast<std::uint32_t>(found);
        if (at == points.size()) points.push_back(p);
        return at;
    }
    void add(Triangle t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        const auto at = [&](unsigned i) { return points[t[i]]; };
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
        if (collinear(at(0), at(1), at(2))) return;
        Triangle sorted = t;
        std::sort(sorted.begin(), sorted.end());
        if (known.insert(sorted).second) triangles.push_back(t);
    }

    std::set<Triangle> known{};
};

/// Triangles at the first of some points, many of them at the edges to the second and third, and a
/// few that are elsewhere.
Fans random_fans(Random& random, Family family) {
    Fans fans;
    const int count = random_int(random, 150, 260);
    const auto points = points_of(random, family, 64);
    for (const Point3& p : points) fans.vertex(p);
    const auto last = static_cast<int>(fans.points.size()) - 1;
    const auto any = [&] { return static_cast<std::uint32_t>(random_int(random, 0, last)); };
    const int second = random_int(random, 0, 3), third = random_int(random, 0, 3);
    for (int i = 0; i < 4 * count && fans.triangles.size() < static_cast<std::size_t>(count); ++i) {
        const int kind = random_int(random, 0, 9);
        if (kind < 3 * second / 2 && last > 0)
            fans.add({0, 1, any()});
        else if (kind < 2 * third && last > 1)
            fans.add({2, any(), 0});
        else if (kind < 9)
            fans.add({0, any(), any()});
        else
            fans.add({any(), any(), any()});
    }
    return fans;
}

bool meet_improperly(const Fans& fans, const CandidatePair& p) {
    return improper_contact(fans.points, fans.triangles[p.first], fans.triangles[p.second])
        .has_value();
}

/// Every pair that meets improperly, by testing all.
Pairs improper_pairs(const Fans& fans) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < fans.triangles.size(); ++i)
        for (std::uint32_t j = i + 1; j < fans.triangles.size(); ++j)
            if (meet_improperly(fans, {i, j})) pairs.push_back({i, j});
    return pairs;
}

bool contains(const Pairs& all, const Pairs& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

Pairs found_by_search(const Fans& fans, const std::vector<std::uint32_t>& groups = {}) {
    return candidate_pairs({fans.points, fans.triangles}, groups, Search::bvh);
}

std::uint64_t all_pairs(const Fans& fans) {
    return fans.triangles.size() * (fans.triangles.size() - 1) / 2;
}

Fans cones(int count, double tip_x) {
    Fans fans;
    const std::uint32_t tip = fans.vertex({tip_x, 4.2e6, -300});
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * M_PI * (i % 50) / 50, z = 0.25 + i / 50;
        const auto at = [&](double turn) {
            return fans.vertex({tip_x + std::cos(turn), 4.2e6 + std::sin(turn), z - 300});
        };
        const std::uint32_t a = at(angle), b = at(angle + M_PI / 50);
        fans.add({tip, a, b});
    }
    return fans;
}

} // namespace

TEST_CASE("stars: no pair that meets improperly is missed") {
    Random random(20261);
    std::size_t crowded = 0, left_out = 0;
    for (int k = 0; k < cases(15); ++k)
        for (const Family family : all_families) {
            const Fans fans = random_fans(random, family);
            const Pairs right = improper_pairs(fans), pairs = found_by_search(fans);
            INFO("case " << k << ", family " << static_cast<int>(family));
            REQUIRE(contains(pairs, right));
            REQUIRE(std::is_sorted(pairs.begin(), pairs.end()));
            REQUIRE(std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end());
            const bool any = !crowded_vertices(fans.points.size(), fans.triangles).empty();
            crowded += any ? 1 : 0;
            const auto by_boxes =
                candidate_pairs({fans.points, fans.triangles}, {}, Search::brute).size();
            left_out += by_boxes - pairs.size();
            REQUIRE((any || by_boxes == pairs.size()));
        }
    CHECK(crowded > 0); // else the test would say nothing
    CHECK(left_out > 0);
}

TEST_CASE("stars: groups, active triangles and filters are as without crowded vertices") {
    Random random(20262);
    for (int k = 0; k < cases(40); ++k) {
        const Fans fans = random_fans(random, Family::lattice);
        const auto count = static_cast<std::uint32_t>(fans.triangles.size());
        std::vector<std::uint32_t> groups(count), active;
        for (std::uint32_t& g : groups) {
            g = static_cast<std::uint32_t>(random_int(random, 0, 12)); // more than there are trees
            if (g == 12) g = no_group;
        }
        for (std::uint32_t t = 0; t < count; ++t)
            if (random_int(random, 0, 2) == 0) active.push_back(t);
        const auto in_one = [&](const CandidatePair& p) {
            return groups[p.first] != no_group && groups[p.first] == groups[p.second];
        };
        const auto is_active = [&](const CandidatePair& p) {
            return std::binary_search(active.begin(), active.end(), p.first) ||
                   std::binary_search(active.begin(), active.end(), p.second);
        };
        Pairs right = improper_pairs(fans);
        std::erase_if(right, in_one);
        const Pairs grouped = found_by_search(fans, groups);
        REQUIRE(contains(grouped, right));
        REQUIRE(std::none_of(grouped.begin(), grouped.end(), in_one));
        std::erase_if(right, [&](const CandidatePair& p) { return !is_active(p); });
        const auto improper = [&](const CandidatePair& p) { return meet_improperly(fans, p); };
        for (const unsigned threads : {1U, 3U})
            REQUIRE(candidate_pairs_of({fans.points, fans.triangles}, active, groups, improper,
                                       {.threads = threads}) == right);
    }
}

TEST_CASE("stars: triangles on cones with one tip give few pairs, wherever they are") {
    for (const double x : {0.0, 5e5, 1e9}) {
        const Fans fans = cones(2000, x);
        const Pairs pairs = found_by_search(fans);
        CHECK(contains(pairs, improper_pairs(fans)));
        CHECK(pairs.size() < all_pairs(fans) / 50);
    }
}

TEST_CASE("stars: triangles at one edge give a pair only if they lie in one half-plane") {
    Fans fans;
    const std::uint32_t a = fans.vertex({0, 0, 0}), b = fans.vertex({0, 0, 1});
    for (int i = 0; i < 1000; ++i) {
        const double angle = 2 * M_PI * i / 1000;
        fans.add({a, b, fans.vertex({std::cos(angle), std::sin(angle), 0.5})});
    }
    CHECK(found_by_search(fans).size() < 10);
    // Two more in a half-plane that there is already.
    fans.add({a, b, fans.vertex({2, 0, 0.5})});
    fans.add({a, b, fans.vertex({3, 0, 0.25})});
    const Pairs pairs = found_by_search(fans);
    CHECK(pairs.size() < 20);
    CHECK(contains(pairs, {{0, 1000}, {0, 1001}, {1000, 1001}}));
    CHECK(improper_pairs(fans) == Pairs{{0, 1000}, {0, 1001}, {1000, 1001}});
}
