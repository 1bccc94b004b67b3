// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the search by turned boxes with a test of every pair of boxes: what it leaves out is apart.
#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/thin_solids.hpp"

#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/search/detail/turned_tree.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/numbers.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace {

using namespace terrane;
using namespace test_support;
using Pairs = std::vector<CandidatePair>;

struct Soup {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;

    [[nodiscard]] BoxSource source() const { return {points, triangles}; }
    [[nodiscard]] bool are_joined(const CandidatePair& p) const {
        return std::ranges::any_of(triangles[p.first], [&](std::uint32_t v) {
            return std::ranges::find(triangles[p.second], v) != triangles[p.second].end();
        });
    }
    [[nodiscard]] bool meet(const CandidatePair& p) const {
        return improper_contact(points, triangles[p.first], triangles[p.second], Filters::none)
            .has_value();
    }
};

bool has_area(const Soup& soup, const Triangle& t) {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0] &&
           !collinear(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
}

/// Returns a copy with other coordinates.
Soup mapped(const Soup& soup, const std::function<Point3(const Point3&)>& map) {
    Soup copy = soup;
    for (Point3& p : copy.points) p = map(p);
    return copy;
}

/// Returns the pairs of one tree with itself.
Pairs pairs_of_tree(const Soup& soup) {
    std::vector<std::uint32_t> all(soup.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    const search::UnitMap map(soup.source(), all);
    const search::TurnedTree tree(soup.source(), all, {}, map);
    Pairs found;
    for (std::size_t l = 0; l < tree.leaf_count(); ++l)
        tree.join(l, tree, [&](std::uint32_t f, std::uint32_t g) {
            found.push_back({std::min(f, g), std::max(f, g)});
        });
    std::ranges::sort(found);
    REQUIRE(std::ranges::adjacent_find(found) == found.end());
    return found;
}

/// Checks that only pairs are left out that are apart, whatever the rounding of their points: pairs that do not
/// meet where each point is moved to its neighbours either. Returns the number of pairs left out.
std::size_t check(const Soup& soup, const Pairs& found, bool moves = false) {
    const Pairs all = candidate_pairs(soup.source(), {}, Search::brute);
    REQUIRE(std::ranges::includes(all, found));
    Pairs left_out;
    std::ranges::set_difference(all, found, std::back_inserter(left_out));
    const UpwardRounding guard;
    Random random(3);
    Soup moved = soup;
    for (unsigned k = 0; k < (moves ? 3 : 1); ++k) {
        std::size_t wrong = 0;
        for (const CandidatePair& p : left_out)
            wrong += soup.are_joined(p) || moved.meet(p) ? 1 : 0;
        CHECK(wrong == 0);
        for (std::size_t i = 0; i < soup.points.size(); ++i)
            moved.points[i] = nudged(random, soup.points[i]);
    }
    return left_out.size();
}

std::size_t check_tree(const Soup& soup, bool moves = false) {
    return check(soup, pairs_of_tree(soup), moves);
}

/// Triangles between points of a lattice, which touch, overlap in planes and share corners often; most are
/// long.
Soup lattice_soup(Random& random, int count) {
    Soup soup;
    for (int x = 0; x < 6; ++x)
        for (int y = 0; y < 6; ++y)
            for (int z = 0; z < 6; ++z) soup.points.push_back({double(x), double(y), double(z)});
    const auto last = static_cast<int>(soup.points.size()) - 1;
    while (static_cast<int>(soup.triangles.size()) < count) {
        Triangle t{};
        for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random_int(random, 0, last));
        std::ranges::sort(t);
        if (has_area(soup, t)) soup.triangles.push_back(t);
    }
    std::ranges::sort(soup.triangles);
    const auto end = std::unique(soup.triangles.begin(), soup.triangles.end());
    soup.triangles.erase(end, soup.triangles.end());
    return soup;
}

/// Thin triangles of any direction, in pairs of parallel ones that are about an ulp of the coordinates apart, touch,
/// or lie in one plane.
Soup near_needles(Random& random, int count, double far) {
    Soup soup;
    for (int k = 0; k < count; ++k) {
        const auto at = [&] { return random_real(random, -1, 1); };
        const Point3 from{far + at(), far + at(), at()}, to{far + at(), far + at(), at()};
        const double width = std::ldexp(1, random_int(random, -30, -6));
        const Point3 side{from.x + width, from.y - width, from.z + width * at()};
        const double gap =
            std::ldexp(far + 1, random_int(random, -55, -45)) * random_int(random, -1, 1);
        for (int twin = 0; twin < 2; ++twin) {
            const auto first = static_cast<std::uint32_t>(soup.points.size());
            for (const Point3& p : {from, to, side})
                soup.points.push_back({p.x + twin * gap, p.y, p.z + twin * gap});
            const Triangle t{first, first + 1, first + 2};
            if (has_area(soup, t)) soup.triangles.push_back(t);
        }
    }
    return soup;
}

Soup soup_of(const Surface& s) {
    return {s.vertices, s.triangles};
}

} // namespace

TEST_CASE("turned boxes: long thin solids have few candidates, and none is missing", "[once]") {
    for (const char* name : thin_solids::names)
        for (const bool shuffled : {false, true}) {
            INFO(name << (shuffled ? ", shuffled" : ""));
            Surface s = thin_solids::solid(name, 4000);
            if (shuffled) thin_solids::shuffle(s);
            const Soup soup = soup_of(s);
            const std::size_t left_out =
                check(soup, candidate_pairs(soup.source(), {}, Search::bvh));
            check_tree(soup);
            if (std::string(name) == "fans") continue; // their triangles share tips
            CHECK(left_out > 50 * soup.triangles.size());
            const Surface large = thin_solids::solid(name, 20000);
            const auto candidates =
                candidate_pairs({large.vertices, large.triangles}, {}, Search::bvh);
            CHECK(candidates.size() < 8 * large.triangles.size());
        }
}

TEST_CASE("turned boxes: candidates between and within groups") {
    const Surface s = thin_solids::loft(1500);
    std::vector<std::uint32_t> groups(s.triangles.size());
    for (const std::uint32_t count : {2U, 40U}) {
        for (std::size_t t = 0; t < groups.size(); ++t)
            groups[t] =
                t % 7 == 0 ? no_group : static_cast<std::uint32_t>(t * count / groups.size());
        const auto found = candidate_pairs({s.vertices, s.triangles}, groups, Search::bvh);
        auto all = candidate_pairs({s.vertices, s.triangles}, {}, Search::bvh);
        std::erase_if(all, [&](const CandidatePair& p) {
            return groups[p.first] != no_group && groups[p.first] == groups[p.second];
        });
        const Soup soup = soup_of(s);
        const auto joined = [&](const Pairs& pairs) {
            return std::ranges::count_if(
                pairs, [&](const CandidatePair& p) { return soup.are_joined(p); });
        };
        CHECK(joined(found) == joined(all));
        for (const CandidatePair& p : found)
            REQUIRE((groups[p.first] == no_group || groups[p.first] != groups[p.second]));
    }
}

TEST_CASE("turned boxes: a stop that came before is heeded") {
    const Surface s = thin_solids::solid("loft", 4000);
    std::vector<std::uint32_t> groups(s.triangles.size());
    for (std::size_t t = 0; t < groups.size(); ++t) groups[t] = t % 2;
    std::stop_source source;
    source.request_stop();
    const Run stopped{.stop = source.get_token()};
    CHECK(candidate_pairs({s.vertices, s.triangles}, {}, Search::bvh, stopped).empty());
    CHECK(candidate_pairs({s.vertices, s.triangles}, groups, Search::bvh, stopped).empty());
}

TEST_CASE("turned boxes: lattices, whatever their scale and place") {
    Random random(91);
    for (int k = 0; k < 2; ++k) {
        const Soup soup = lattice_soup(random, 700);
        CHECK(check_tree(soup) > 0);
        for (const double scale : {1e-150, 1e150, 0x1p-1074, 0x1p1020}) {
            INFO(scale);
            check_tree(mapped(soup, [&](const Point3& p) {
                return Point3{scale * p.x, scale * p.y, scale * p.z};
            }));
        }
        CHECK(check_tree(mapped(soup, [](const Point3& p) {
                  return Point3{512345.5 + p.x / 3, 4212345.25 + p.y / 7 + p.x / 9,
                                p.z / 5 - p.y / 3};
              })) > 0);
    }
}

TEST_CASE("turned boxes: needles at the distance of an ulp") {
    Random random(92);
    for (const double far : {0.0, 512345.25, 1e12}) {
        INFO(far);
        check_tree(near_needles(random, 350, far), true);
    }
    CHECK(check_tree(near_needles(random, 350, 0)) > 10000);
}

TEST_CASE("turned boxes contain their triangles, and are apart only if all of them are") {
    Random random(93);
    for (int k = 0; k < cases(160); ++k) {
        const double far = k % 3 == 0 ? 4e6 : 0;
        Soup soup = near_needles(random, 40, far);
        std::vector<std::uint32_t> half(soup.triangles.size() / 2),
            rest(soup.triangles.size() - half.size());
        std::iota(half.begin(), half.end(), 0U);
        std::iota(rest.begin(), rest.end(), static_cast<std::uint32_t>(half.size()));
        const search::UnitMap map(soup.source(), half, rest);
        const search::TurnedTree a(soup.source(), half, {}, map), b(soup.source(), rest, {}, map);
        Pairs found;
        for (std::size_t l = 0; l < a.leaf_count(); ++l)
            a.join(l, b, [&](std::uint32_t f, std::uint32_t g) { found.push_back({f, g}); });
        std::ranges::sort(found);
        REQUIRE(std::ranges::adjacent_find(found) == found.end());
        for (const std::uint32_t f : half)
            for (const std::uint32_t g : rest)
                if (!std::ranges::binary_search(found, CandidatePair{f, g}))
                    REQUIRE_FALSE(soup.meet({f, g}));
    }
}
