// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/boxes.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/search/detail/packed_box.hpp>
#include <terrane/algorithms/search/methods.hpp>
#include <terrane/algorithms/search/search.hpp>

#include <catch2/catch.hpp>

using namespace terrane;
using namespace test_support;
using namespace box_cases;

TEST_CASE("the mixed search keeps what lies in cells of both") {
    std::vector<Box> boxes; // two perpendicular rows, which meet in the middle
    Groups groups;
    for (int i = 0; i < 50; ++i) {
        boxes.push_back(box({i * 1.0, 25, 0}, {1, 1, 1}));
        groups.push_back(0);
        boxes.push_back(box({25, i * 1.0, 0}, {1, 1, 1}));
        groups.push_back(1);
    }
    const auto kept = search::boxes_in_mixed_cells(boxes, groups);
    CHECK(kept.size() >= 6);
    CHECK(kept.size() <= 12);
    CHECK(search::boxes_in_mixed_cells(boxes, Groups(100, 4)).empty());
    CHECK(search::boxes_in_mixed_cells(boxes, Groups(100, no_group)).size() == 100);
}
