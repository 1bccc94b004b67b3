// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/box_cover.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <random>

namespace {

using namespace terrane;

bool is_inside(const Box& inner, const Box& outer) {
    for (unsigned k = 0; k < 3; ++k)
        if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
    return true;
}

/// Boxes with corners on a lattice, some of which are flat, lines or points.
std::vector<Box> lattice_boxes(std::mt19937& random, std::size_t count, unsigned range,
                               unsigned side) {
    std::vector<Box> boxes(count);
    for (Box& box : boxes)
        for (unsigned k = 0; k < 3; ++k) {
            box.low[k] = static_cast<double>(random() % range);
            box.high[k] = box.low[k] + static_cast<double>(random() % side);
        }
    return boxes;
}

double volume(const Box& b) {
    return (b.high[0] - b.low[0]) * (b.high[1] - b.low[1]) * (b.high[2] - b.low[2]);
}

double volume(const std::vector<Box>& boxes) {
    double sum = 0;
    for (const Box& b : boxes) sum += volume(b);
    return sum;
}

} // namespace

TEST_CASE("box cover: answers are those of a look at each box", "[search]") {
    std::mt19937 random(1);
    std::size_t overlapping = 0, contained = 0, neither = 0;
    for (const std::size_t count : {0, 1, 2, 3, 7, 30, 200})
        for (unsigned round = 0; round < 20; ++round) {
            const auto boxes = lattice_boxes(random, count, 20, 1 + round % 6);
            const BoxCover cover(boxes);
            for (const Box& box : lattice_boxes(random, 50, 20, 4)) {
                std::uint64_t compared = 0;
                const bool overlaps =
                    std::ranges::any_of(boxes, [&](const Box& b) { return b.overlaps(box); });
                const bool contains =
                    std::ranges::any_of(boxes, [&](const Box& b) { return is_inside(box, b); });
                CHECK(cover.overlaps(box, compared) == overlaps);
                CHECK(cover.contains(box, compared) == contains);
                CHECK(compared >= (count > 0 ? 2 : 0));
                overlapping += overlaps ? 1 : 0;
                contained += contains ? 1 : 0;
                neither += overlaps ? 0 : 1;
            }
        }
    CHECK(std::min({overlapping, contained, neither}) >= 50);
}

TEST_CASE("box cover: united boxes cover what the given ones do, in no more volume", "[search]") {
    std::mt19937 random(2);
    std::size_t fewer = 0;
    for (const unsigned range : {3U, 10U, 40U, 1000U})
        for (unsigned round = 0; round < 20; ++round) {
            const auto boxes = lattice_boxes(random, 1 + random() % 300, range, 1 + round % 8);
            const auto fresh = united(boxes);
            CHECK(volume(fresh) <= volume(boxes) * (1 + 1e-9));
            for (const Box& box : boxes)
                CHECK(std::ranges::any_of(fresh, [&](const Box& b) { return is_inside(box, b); }));
            fewer += fresh.size() < boxes.size() ? 1 : 0;
            auto shuffled = boxes;
            std::shuffle(shuffled.begin(), shuffled.end(), random);
            const auto again = united(shuffled);
            CHECK(std::ranges::equal(again, fresh, {}, &Box::low, &Box::low));
            CHECK(std::ranges::equal(again, fresh, {}, &Box::high, &Box::high));
        }
    CHECK(fewer > 20);
    CHECK(fewer < 80);
}

TEST_CASE("box cover: boxes that fill the box around them become it, others stay", "[search]") {
    CHECK(united({}).empty());
    const Box cube{{0, 0, 0}, {1, 1, 1}}, beside{{1, 0, 0}, {2, 1, 1}}, far{{9, 9, 9}, {9, 9, 9}};
    CHECK(united({cube, beside}).size() == 1);
    CHECK(united({cube, beside, far, far}).size() == 2);
    CHECK(united(std::vector<Box>(1000, far)).size() == 1);
    const Box flat{{0, 0, 0}, {4, 4, 0}}, across{{0, 0, 0}, {4, 0, 4}};
    CHECK(united({flat, across}).size() == 2);
    // Volumes of such boxes underflow, and sides of such ones overflow.
    const double least = std::numeric_limits<double>::denorm_min(),
                 most = std::numeric_limits<double>::max();
    CHECK(united(
              {{{0, 0, 0}, {least, least, least}}, {{9 * least, 0, 0}, {10 * least, least, least}}})
              .size() == 2);
    CHECK(united({{{-most, -most, -most}, {most, most, most}}, cube}).size() == 1);
    // Pieces all over a cube, which overlap each other 8 times.
    std::mt19937 random(3);
    CHECK(united(lattice_boxes(random, 20'000, 20, 4)).size() < 2'000);
}

TEST_CASE("box cover: comparisons do not multiply with boxes that overlap", "[search]") {
    // Each of n boxes overlaps all others; n^2 comparisons would be 10^10.
    std::mt19937 random(4);
    const auto boxes = lattice_boxes(random, 100'000, 2, 4);
    const auto fresh = united(boxes);
    CHECK(fresh.size() < 10);
    const BoxCover cover(boxes);
    std::uint64_t compared = 0;
    for (const Box& box : boxes) {
        CHECK(cover.overlaps(box, compared));
        CHECK(cover.contains(box, compared));
    }
    CHECK(compared < 1000 * boxes.size());
}
