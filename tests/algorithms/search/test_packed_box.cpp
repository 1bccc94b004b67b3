// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/boxes.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/search/detail/packed_box.hpp>
#include <terrane/algorithms/search/methods.hpp>
#include <terrane/algorithms/search/search.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace terrane;
using namespace test_support;
using namespace box_cases;

TEST_CASE("packed boxes are compared as their coordinates are, one by one and eight at once") {
    using search::PackedBox;
    Random random(48);
    // There are few different coordinates, so that many are equal; they include the ends of the
    // range.
    constexpr std::array<std::uint64_t, 5> values{0, 1, 2, PackedBox::last - 1, PackedBox::last};
    const auto any = [&] {
        std::array<std::uint64_t, 3> low{}, high{};
        for (unsigned k = 0; k < 3; ++k) {
            low[k] = values[random() % values.size()];
            high[k] = values[random() % values.size()];
            if (low[k] > high[k]) std::swap(low[k], high[k]);
        }
        return PackedBox::of(low, high);
    };
    std::size_t inside = 0;
    for (int i = 0; i < 2000; ++i) {
        const PackedBox q = any();
        search::EightBoxes eight;
        REQUIRE(eight.overlapping(q) == 0);
        const unsigned count = random() % 9;
        for (unsigned b = 0; b < count; ++b) eight.set(b, any());
        const unsigned found = eight.overlapping(q);
        for (unsigned b = 0; b < 8; ++b) {
            const PackedBox box = eight[b];
            bool overlap = b < count, beyond = true;
            for (unsigned k = 0; k < 3 && b < count; ++k) {
                const auto reach = std::min(box.high_of(k), q.high_of(k)),
                           start = std::max(box.low_of(k), q.low_of(k));
                overlap = overlap && start <= reach;
                beyond = beyond && box.low_of(k) < q.high_of(k) && q.low_of(k) < box.high_of(k);
            }
            REQUIRE(q.overlaps(box) == overlap);
            REQUIRE(((found >> b) & 1) == (overlap ? 1 : 0));
            if (!overlap) continue;
            REQUIRE(q.overlaps_inside(box) == beyond);
            inside += beyond ? 1 : 0;
        }
    }
    CHECK(inside > 100);
}
