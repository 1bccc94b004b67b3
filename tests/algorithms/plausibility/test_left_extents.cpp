// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the trees with a look at every extent, and counts what they look at.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/plausibility/detail/left_extents.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>

using namespace terrane;
using namespace terrane::plausibility::detail;

namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers all_numbers(std::size_t count) {
    Numbers all(count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

/// A flat box.
Extent box(double x, double y, double width, double height) {
    return {{x, y, 0}, {x + width, y + height, 0}};
}

/// Boxes of sizes from 2^-10 to 2^10, of which some are points.
std::vector<Extent> random_boxes(std::size_t count, double spread, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0, spread), share(0, 1);
    std::uniform_int_distribution<int> size(-10, 10);
    std::vector<Extent> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const double s = i % 7 == 0 ? 0 : std::ldexp(1.0, size(random));
        boxes.push_back(box(place(random), place(random), s * share(random), s * share(random)));
    }
    return boxes;
}

Numbers near_to(const Extent& here, const std::vector<Extent>& boxes, const Numbers& left) {
    Numbers found;
    for (const std::uint32_t s : left)
        if (are_near(here, boxes[s], 1)) found.push_back(s);
    return found;
}

/// Takes out all extents as check_distances() does; returns how many nodes were looked at.
std::size_t visits_of(const std::vector<Extent>& boxes) {
    LeftExtents left(boxes, all_numbers(boxes.size()));
    for (std::uint32_t s = 0; s < boxes.size(); ++s) {
        if (!left.holds(s)) continue;
        Numbers group;
        left.take_near(boxes[s], 1, group);
        for (std::size_t i = 0; i < group.size(); ++i) left.take_near(boxes[group[i]], 1, group);
    }
    return left.visits();
}

Surface triangle(double x, double y, double size) {
    Surface s;
    s.vertices = {{x, y, 0}, {x + size, y, 0}, {x, y + size, 0}};
    s.triangles = {{0, 1, 2}};
    return s;
}

} // namespace

TEST_CASE("plausibility: trees of extents find what a look at each finds", "[plausibility]") {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        INFO(seed);
        const auto boxes = random_boxes(1 + seed % 90, seed % 2 == 0 ? 100 : 3000, seed);
        Numbers rest = all_numbers(boxes.size());
        LeftExtents left(boxes, rest);
        for (std::uint32_t s = 0; s < boxes.size(); ++s) {
            const auto expected = near_to(boxes[s], boxes, rest);
            Numbers taken;
            left.take_near(boxes[s], 1, taken);
            std::ranges::sort(taken);
            CHECK(taken == expected);
            std::erase_if(rest, [&](std::uint32_t r) { return std::ranges::count(taken, r) > 0; });
            for (std::uint32_t r = 0; r < boxes.size(); ++r)
                CHECK(left.holds(r) == (std::ranges::count(rest, r) > 0));
        }
        CHECK(rest.empty());
    }
}

TEST_CASE("plausibility: the work for each surface does not grow with their number",
          "[plausibility]") {
    const auto row = [](std::size_t n, double step) {
        std::vector<Extent> boxes;
        for (std::size_t i = 0; i < n; ++i)
            boxes.push_back(box(step * static_cast<double>(i), 0, 1, 1));
        return boxes;
    };
    const auto piled = [](std::size_t n) { return std::vector<Extent>(n, box(0, 0, 1, 1)); };
    const auto nested = [](std::size_t n) {
        std::vector<Extent> boxes;
        for (std::size_t i = 0; i < n; ++i) {
            const double r = static_cast<double>(i + 1);
            boxes.push_back(box(-r, -r, 2 * r, 2 * r));
        }
        return boxes;
    };
    const auto mixed = [](std::size_t n) {
        return random_boxes(n, 40 * std::sqrt(static_cast<double>(n)), 1);
    };
    for (const std::size_t n : {2000U, 8000U}) {
        INFO(n);
        CHECK(visits_of(row(n, 2)) < 60 * n); // one group
        CHECK(visits_of(row(n, 9)) < 60 * n); // n groups
        CHECK(visits_of(piled(n)) < 60 * n);
        CHECK(visits_of(nested(n)) < 60 * n);
        CHECK(visits_of(mixed(n)) < 400 * n); // there are 22 powers of two
    }
}

TEST_CASE("plausibility: very many warnings of a kind become one", "[plausibility]") {
    std::vector<Surface> surfaces;
    for (int i = 0; i < 22; ++i) surfaces.push_back(triangle(1e6 * i, 0, 1000));
    REQUIRE(find_doubts(surfaces).size() == 21); // each but the first
    surfaces.push_back(triangle(1e8, 0, 1000));
    surfaces.push_back(triangle(2e8, 0, 1000));
    const auto doubts = find_doubts(surfaces);
    REQUIRE(doubts.size() == 21);
    CHECK(doubts.back().doubt == Doubt::far_apart);
    CHECK(doubts.back().seen == "the same is seen in 3 more places");
    CHECK(doubts.back().surfaces == std::vector{SurfaceId(21), SurfaceId(22), SurfaceId(23)});
}
