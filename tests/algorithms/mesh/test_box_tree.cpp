// SPDX-License-Identifier: LGPL-3.0-or-later
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/box_tree.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>

using namespace terrane;

TEST_CASE("box tree: it finds the boxes that a look at each finds", "[mesh]") {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        std::mt19937_64 random(seed);
        std::uniform_int_distribution<int> place(0, 20), size(-1, 6);
        std::vector<BoxTree::Box> boxes;
        for (std::uint64_t b = 0; b < seed % 50; ++b) {
            const Point3 low{double(place(random)), double(place(random)), double(place(random))};
            const int extent = size(random); // -1: empty
            boxes.push_back({low, {low.x + extent, low.y + extent / 2.0, low.z + extent / 3.0}});
            if (extent < 0) boxes.back().low.x = HUGE_VAL;
        }
        const BoxTree tree(boxes);
        for (int k = 0; k < 20; ++k) {
            const Point3 p{double(place(random)), double(place(random)), double(place(random))};
            const double bound = k / 2.0;
            std::vector<std::uint32_t> expected;
            for (std::uint32_t b = 0; b < boxes.size(); ++b)
                if (boxes[b].low.x <= boxes[b].high.x &&
                    distance_to_box(p, boxes[b].low, boxes[b].high) < bound)
                    expected.push_back(b);
            CHECK(tree.within(p, bound) == expected);
        }
    }
}
