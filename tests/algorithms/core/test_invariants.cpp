// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <array>
#include <vector>

#include <terrane/algorithms/core/invariants.hpp>

using namespace terrane;

TEST_CASE("invariants: sorted unique lists and indices in range") {
    CHECK(is_sorted_unique(std::vector<int>{}));
    CHECK(is_sorted_unique(std::vector<int>{1, 2, 5}));
    CHECK_FALSE(is_sorted_unique(std::vector<int>{1, 2, 2}));
    CHECK_FALSE(is_sorted_unique(std::vector<int>{1, 3, 2}));
    CHECK(all_below(std::vector<unsigned>{0, 4}, 5));
    CHECK_FALSE(all_below(std::vector<unsigned>{0, 5}, 5));
    const std::vector<std::array<std::uint32_t, 3>> cells{{0, 1, 2}, {2, 1, 3}};
    CHECK(corners_below(cells, 4));
    CHECK_FALSE(corners_below(cells, 3));
}

TEST_CASE("invariants: lists in two flat arrays") {
    IndexLists<std::uint32_t> lists;
    CHECK(has_valid_offsets(lists));
    CHECK(are_sorted_lists(lists, 0));
    lists.push_back(std::vector<std::uint32_t>{1, 3});
    lists.push_back(std::vector<std::uint32_t>{2});
    CHECK(are_sorted_lists(lists, 2));
    CHECK_FALSE(are_sorted_lists(lists, 1));
    auto broken = lists;
    broken.offsets = {0, 3, 2};
    CHECK_FALSE(has_valid_offsets(broken));
    broken = lists;
    broken.values.push_back(7);
    CHECK_FALSE(has_valid_offsets(broken));
    broken = lists;
    broken.values[1] = 1;
    CHECK(has_valid_offsets(broken));
    CHECK_FALSE(are_sorted_lists(broken, 2));
    lists.close();
    CHECK(has_valid_offsets(lists));
    CHECK_FALSE(are_sorted_lists(lists, 3)); // the last one is empty
}
