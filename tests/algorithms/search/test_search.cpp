// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares all search methods with comparing every box with every other.
#include "support/boxes.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/search/detail/packed_box.hpp>
#include <terrane/algorithms/search/methods.hpp>
#include <terrane/algorithms/search/search.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <stop_token>

namespace {

using namespace terrane;
using namespace test_support;
using namespace box_cases;
using Pairs = std::vector<CandidatePair>;

std::vector<Search> all_methods() {
    std::vector<Search> methods;
    for (int m = 0; m <= static_cast<int>(Search::brute); ++m)
        methods.push_back(static_cast<Search>(m));
    return methods;
}

Pairs expected(const std::vector<Box>& boxes, const Groups& groups) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
            const bool together =
                !groups.empty() && groups[i] != no_group && groups[i] == groups[j];
            if (!together && meet(boxes[i], boxes[j])) pairs.push_back({i, j});
        }
    return pairs;
}

/// Checks that all methods find the same pairs, and returns their number.
std::size_t check(const std::vector<Box>& boxes, const Groups& groups = {}) {
    const Pairs right = expected(boxes, groups);
    for (const Search method : all_methods()) {
        INFO(name_of(method) << ", " << boxes.size() << " boxes");
        REQUIRE(candidate_pairs(boxes, groups, method) == right);
    }
    return right.size();
}

enum class Kind { cells, sizes, flat, ratios, lattice, far, everything };

double extent(Random& random, Kind kind) {
    switch (kind) {
    case Kind::cells:
        return 1;
    case Kind::flat:
        return random_int(random, 0, 1);
    case Kind::ratios:
        return std::ldexp(1, random_int(random, -60, 3));
    case Kind::lattice:
        return random_int(random, 0, 3);
    case Kind::far:
        return 1e-3 * random_int(random, 0, 9);
    default:
        return random_real(random, 0, 1.5);
    }
}

std::vector<Box> random_boxes(Random& random, Kind kind) {
    std::vector<Box> boxes;
    const int count = random_int(random, 2, 120);
    for (int i = 0; i < count; ++i) {
        const Kind k =
            kind == Kind::everything ? static_cast<Kind>(random_int(random, 0, 5)) : kind;
        const bool on_grid = k == Kind::cells || k == Kind::flat || k == Kind::lattice;
        Point3 corner = point_of(
            [&] { return on_grid ? random_int(random, 0, 8) : random_real(random, 0, 8); });
        if (k == Kind::far) corner.x += 5e5, corner.y += 4.2e6;
        boxes.push_back(box(corner, point_of([&] { return extent(random, k); })));
    }
    return boxes;
}

/// Searches as in the paper, 2.1, along one axis, but without the widening: it visits only the
/// cells that the query box overlaps.
Pairs without_widening(const std::vector<Box>& boxes, double cell) {
    const auto index = [&](double x) { return std::floor(x / cell); };
    Pairs pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
            const double stored = index((boxes[j].low[0] + boxes[j].high[0]) / 2);
            const bool looked_at =
                index(boxes[i].low[0]) <= stored && stored <= index(boxes[i].high[0]);
            if (looked_at && meet(boxes[i], boxes[j])) pairs.push_back({i, j});
        }
    return pairs;
}

} // namespace

TEST_CASE("searches: none, one, two") {
    CHECK(check({}) == 0);
    CHECK(check({box({1, 2, 3}, {1, 1, 1})}) == 0);
    CHECK(check({box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {1, 1, 1})}) == 1); // a shared corner
    CHECK(check({box({0, 0, 0}, {1, 1, 1}), box({1 + 0x1p-52, 0, 0}, {1, 1, 1})}) == 0);
    CHECK(check({box({0, 0, 0}, {0, 0, 0}), box({0, 0, 0}, {0, 0, 0})}) == 1);    // points
    CHECK(check({box({-1, -1, -1}, {9, 9, 9}), box({0, 0, 0}, {1, 1, 1})}) == 1); // within
}

TEST_CASE("searches: all boxes equal") {
    CHECK(check(std::vector<Box>(50, box({3, 4, 5}, {1, 2, 3}))) == 50 * 49 / 2);
    CHECK(check(std::vector<Box>(50, box({3, 4, 5}, {0, 0, 0}))) == 50 * 49 / 2);
    CHECK(check(std::vector<Box>(50, box({3, 4, 5}, {0, 0, 0})), Groups(50, 7)) == 0);
}

TEST_CASE("searches: a row of boxes that touch at cell walls") {
    std::vector<Box> boxes;
    for (int i = 0; i < 100; ++i) boxes.push_back(box({double(i), 0, 0}, {1, 1, 1}));
    CHECK(check(boxes) == 99);
    for (Box& b : boxes) b.low[0] += 0.5, b.high[0] += 0.5;
    boxes.push_back(box({0, 0, 0}, {0, 1, 1})); // shifts all cells
    CHECK(check(boxes) == 99);
}

TEST_CASE("searches: one box among many is larger by a factor of 2^60") {
    Random random(51);
    auto boxes = random_boxes(random, Kind::sizes);
    boxes.push_back(box({-0x1p59, -0x1p59, -0x1p59}, {0x1p60, 0x1p60, 0x1p60}));
    check(boxes);
    boxes.push_back(box({-1e308, 0, 0}, {1.5e308, 1, 1})); // their extent exceeds the doubles
    boxes.push_back(box({0.9e308, 0, 0}, {0.8e308, 1, 1}));
    check(boxes);
}

TEST_CASE("searches: coordinates near the ends of the range") {
    for (const double size : {5e-324, 1e-300, 1e300}) {
        std::vector<Box> boxes;
        for (int i = 0; i < 40; ++i)
            boxes.push_back(box({i % 7 * size, i % 5 * size, i % 3 * size}, {size, 0, size}));
        CHECK(check(boxes) > 30);
    }
}

TEST_CASE("searches agree with brute force on random boxes of all kinds, with and without groups") {
    Random random(52);
    std::size_t pairs = 0;
    for (const Kind kind : {Kind::cells, Kind::sizes, Kind::flat, Kind::ratios, Kind::lattice,
                            Kind::far, Kind::everything})
        for (int i = 0; i < cases(120); ++i) {
            const auto boxes = random_boxes(random, kind);
            pairs += check(boxes);
            Groups groups;
            for (std::size_t b = 0; b < boxes.size(); ++b)
                groups.push_back(random_int(random, 0, 3) == 0
                                     ? no_group
                                     : static_cast<std::uint32_t>(random_int(random, 0, 2)));
            pairs += check(boxes, groups);
        }
    CHECK(pairs > static_cast<std::size_t>(cases(50'000)));
}

TEST_CASE("searches: the half-cell widening is needed, and there") {
    // Cells have size 1. The second box reaches from cell 1 into cell 0, which has the first box,
    // but is stored in cell 1 alone, by its centre.
    const std::vector<Box> boxes{box({0.2, 0, 0}, {0.6, 0, 0}), box({0.7, 0, 0}, {1, 0, 0}),
                                 box({0, 0, 0}, {0, 0, 0}), box({4, 0, 0}, {0, 0, 0})};
    CHECK(without_widening(boxes, 1).empty());
    CHECK(check(boxes) == 1);
}

TEST_CASE("searches: thousands of boxes of all sizes, some with a group, by several threads") {
    Random random(53);
    const int count = cases(6000);
    std::vector<Box> boxes;
    Groups groups, many;
    for (int i = 0; i < count; ++i) {
        const double size = std::exp2(random_real(random, -14, -1));
        const auto coordinate = [&] { return random_real(random, 0, 1); };
        const auto side = [&] { return size * random_real(random, 0, 1); };
        boxes.push_back(box(point_of(coordinate), point_of(side)));
        groups.push_back(i % 7 == 0 ? no_group : static_cast<std::uint32_t>(i % 3));
        many.push_back(i % 5 == 0 ? UINT32_MAX - 1 : static_cast<std::uint32_t>(i / 2));
    }
    check(boxes);
    for (const Groups& g : {groups, many}) {
        check(boxes, g);
        const Run run{.threads = 2};
        CHECK(candidate_pairs(boxes, g, Search::bvh, run) == expected(boxes, g));
    }
    for (int i = 0; i < count; ++i) groups[static_cast<std::size_t>(i)] = i % 2; // red and blue
    check(boxes, groups);
}

TEST_CASE("searches: two groups that are far apart, meet at a corner, lie in each other") {
    for (const double shift : {0.0, 0.5, 9.0, 10.0, 30.0}) {
        std::vector<Box> boxes;
        Groups groups;
        for (int i = 0; i < 200; ++i) {
            const bool red = i % 2 == 0;
            const double x = i / 2 % 10, y = i / 20, by = red ? 0 : shift;
            boxes.push_back(box({x + by, y + by, by}, {1, 1, red ? 0.0 : 1.0}));
            groups.push_back(red ? 5 : 3);
        }
        check(boxes, groups);
    }
}

TEST_CASE("pairs of active boxes are those pairs with one of them") {
    Random random(54);
    for (const Kind kind : {Kind::cells, Kind::sizes, Kind::ratios, Kind::far, Kind::everything})
        for (const int share : {0, 1, 10, 100})
            for (int n = 0; n < cases(40); ++n) {
                const auto boxes = random_boxes(random, kind);
                std::vector<std::uint32_t> active;
                for (std::uint32_t i = 0; i < boxes.size(); ++i)
                    if (random_int(random, 0, 99) < share) active.push_back(i);
                Pairs right;
                for (const CandidatePair& p : expected(boxes, {}))
                    if (std::binary_search(active.begin(), active.end(), p.first) ||
                        std::binary_search(active.begin(), active.end(), p.second))
                        right.push_back(p);
                REQUIRE(candidate_pairs_of(boxes, active) == right);
            }
}

TEST_CASE("searches tell boxes apart that are as near as no lattice shows") {
    for (unsigned axis = 0; axis < 3; ++axis) {
        std::vector<Box> boxes(40, Box{{0, 0, 0}, {1, 1, 1}});
        for (std::size_t i = 0; i < boxes.size(); ++i) { // gaps of 1e-12, every tenth closed
            boxes[i].low[axis] = static_cast<double>(i) * 2e-12;
            boxes[i].high[axis] = boxes[i].low[axis] + (i % 10 == 0 ? 2e-12 : 1e-12);
        }
        boxes.push_back({{0, 0, 0}, {1, 1, 1}});
        CHECK(check(boxes) >= 40);
        Groups groups(boxes.size());
        for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = i % 2;
        CHECK(check(boxes, groups) >= 20);
    }
}

TEST_CASE("searches: no method goes on to another box once a stop is requested") {
    // A list of nested boxes: each pair overlaps, and trees of the given order are lists.
    std::vector<Box> boxes;
    for (int i = 0; i < 400; ++i)
        boxes.push_back(box({-1.0 * i, -1.0 * i, -1.0 * i}, {2.0 * i, 2.0 * i, 2.0 * i}));
    const std::size_t all = boxes.size() * (boxes.size() - 1) / 2;
    Groups two(boxes.size(), 0);
    for (std::size_t i = 0; i < two.size(); i += 2) two[i] = 1;
    std::stop_source source;
    const Run run{.stop = source.get_token()};
    for (const bool stopped : {false, true}) {
        if (stopped) source.request_stop();
        for (const Search method : all_methods()) {
            INFO(name_of(method) << (stopped ? ", stopped" : ""));
            CHECK(candidate_pairs(boxes, {}, method, run).size() == (stopped ? 0 : all));
            CHECK(candidate_pairs(boxes, two, method, run).size() ==
                  (stopped ? 0 : boxes.size() * boxes.size() / 4));
        }
        // Quadratic for a list: a stop ends it with the first box.
        CHECK(search::AbTree(boxes, run.stop).depth() == (stopped ? 0 : boxes.size()));
        CHECK((search::BalancedAbTree(boxes, run.stop).depth() == 0) == stopped);
    }
}

TEST_CASE("searches: the progress of the hierarchy ascends to 1, and the pairs are the same") {
    // A grid in which each box overlaps its neighbours, deep enough for several waves of leaves.
    constexpr int side = 400;
    std::vector<Box> boxes;
    Groups three;
    std::vector<std::uint32_t> active;
    for (int i = 0; i < side * side; ++i) {
        boxes.push_back(box({1.0 * (i % side), 1.0 * (i / side), 0}, {1.25, 1.25, 1}));
        three.push_back(static_cast<std::uint32_t>(i % 3));
        if (i % 2 == 0) active.push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<double> shares;
    const auto ascends_to_1 = [&] { // in several steps
        const bool is_right = std::is_sorted(shares.begin(), shares.end()) && shares.size() >= 6 &&
                              shares.front() < 0.5 && shares.back() == 1;
        shares.clear();
        return is_right;
    };
    const auto all_alike = [](const CandidatePair&) { return std::size_t{1}; };
    for (const unsigned threads : {1U, 2U}) {
        Run run{.threads = threads};
        run.progress = [&](std::string_view stage, double share) {
            CHECK(stage == "search");
            shares.push_back(share);
        };
        INFO(threads << " threads");
        for (const Groups& groups : {Groups{}, three}) {
            CHECK(candidate_pairs(boxes, groups, Search::bvh, run) ==
                  candidate_pairs(boxes, groups, Search::bvh));
            CHECK(ascends_to_1());
            CHECK(candidate_pairs_of(boxes, active, groups, {}, run) ==
                  candidate_pairs_of(boxes, active, groups));
            CHECK(ascends_to_1());
        }
        const auto counts = count_candidate_pairs(boxes, all_alike, UINT64_MAX, run);
        CHECK(ascends_to_1());
        REQUIRE(counts);
        CHECK(counts == count_candidate_pairs(boxes, all_alike));
        const std::uint64_t all = (*counts)[1];
        const Run quiet{.threads = threads};
        REQUIRE(all > 100);
        CHECK(count_candidate_pairs(boxes, all_alike, all, quiet) == counts);
        CHECK_FALSE(count_candidate_pairs(boxes, all_alike, all - 1, quiet));
        CHECK_FALSE(count_candidate_pairs(boxes, all_alike, 0, quiet));
    }
}

TEST_CASE("names of searches") {
    for (const Search method : all_methods()) CHECK(search_named(name_of(method)) == method);
    CHECK(name_of(Search::automatic) == "auto");
    CHECK(name_of(Search::grid) == "grid");
    CHECK(name_of(Search::ab) == "ab");
    CHECK(name_of(Search::ab_balanced) == "ab-balanced");
    CHECK(name_of(Search::ab_median) == "ab-median");
    CHECK(name_of(Search::mixed) == "mixed");
    CHECK(name_of(Search::bvh) == "hierarchy");
    CHECK(name_of(Search::brute) == "brute");
    CHECK(!search_named("best"));
    CHECK(method_used(Search::automatic, 10) == Search::brute);
    CHECK(method_used(Search::automatic, 1000) == Search::bvh);
    CHECK(method_used(Search::mixed, 10) == Search::mixed);
}
