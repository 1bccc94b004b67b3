// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/boxes.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/search/methods.hpp>
#include <terrane/algorithms/search/search.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

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

TEST_CASE("alternating trees: medians give the shallowest tree, whatever the boxes") {
    const auto levels_of = [](std::size_t boxes) {
        std::size_t levels = 0;
        for (; boxes > 0; boxes /= 2) ++levels;
        return levels;
    };
    Random random(55);
    for (const int count : {0, 1, 2, 3, 7, 8, 100, 1023, 1024, cases(5000)})
        for (const bool equal : {false, true}) {
            INFO(count << " boxes" << (equal ? ", all equal" : ""));
            std::vector<Box> boxes;
            for (int i = 0; i < count; ++i)
                boxes.push_back(equal ? box({1, 2, 3}, {1, 1, 1})
                                      : box(point_of([&] { return random_int(random, 0, 30); }),
                                            point_of([&] { return random_int(random, 0, 3); })));
            search::MedianAbTree tree(boxes);
            CHECK(tree.depth() == levels_of(boxes.size()));
            for (std::size_t i = 0; i < boxes.size(); i += 41) {
                Groups found, right;
                tree.query(boxes[i], [&](std::uint32_t j) { found.push_back(j); });
                std::sort(found.begin(), found.end());
                for (std::uint32_t j = 0; j < boxes.size(); ++j)
                    if (meet(boxes[i], boxes[j])) right.push_back(j);
                CHECK(found == right);
                CHECK(tree.looked_at(boxes[i]) >= right.size());
            }
        }
}

TEST_CASE("alternating trees: on a surface, medians halve the levels of Table 1's order") {
    const Surface grid = unit_grid(60, 60, [](double x, double y) {
        return Point3{x, y, 0.1 * std::sin(6 * x) * std::cos(5 * y)};
    });
    std::vector<Box> boxes;
    for (const Triangle& t : grid.triangles) boxes.push_back(box_of(grid.vertices, t));
    const std::size_t table = search::BalancedAbTree(boxes).depth(),
                      medians = search::MedianAbTree(boxes).depth(),
                      given = search::AbTree(boxes).depth();
    CAPTURE(table, medians, given);
    CHECK(medians == 13); // 7200 boxes
    CHECK(table > 3 * medians / 2);
    CHECK(given > table);
}
