// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/boxes.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/search/methods.hpp>
#include <terrane/algorithms/search/search.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace terrane;
using namespace test_support;
using namespace box_cases;

TEST_CASE("alternating trees: a list does no harm, and Table 1 gives the same boxes") {
    std::vector<Box> boxes; // ascending in all keys, so that the tree is a list
    const int count = cases(5000);
    for (int i = 0; i < count; ++i) boxes.push_back(box({i * 1.0, i * 1.0, i * 1.0}, {1, 1, 1}));
    search::AbTree list(boxes);
    CHECK(list.depth() == boxes.size());
    const auto order = search::table_1_order(boxes);
    REQUIRE(order.size() == boxes.size());
    CHECK(order[0] == boxes.size() / 2);
    search::BalancedAbTree table(boxes);
    CHECK(table.depth() <= 16);
    for (int i = 0; i < count; i += 97) {
        const auto ask = [&](auto& tree) {
            Groups found;
            tree.query(boxes[static_cast<std::size_t>(i)],
                       [&](std::uint32_t j) { found.push_back(j); });
            std::sort(found.begin(), found.end());
            return found;
        };
        const Groups right = ask(list);
        CHECK(right.size() == (i == 0 ? 2 : 3));
        CHECK(ask(table) == right);
    }
}
