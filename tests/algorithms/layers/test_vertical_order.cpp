// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the vertical order of triangles with clipped polygons in rationals.
#include <terrane/algorithms/layers/detail/vertical_order.hpp>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "oracles/clipped.hpp"
#include "support/effort.hpp"

using namespace terrane;
using namespace terrane::layers::detail;

namespace {

using oracles::area;
using oracles::common;
using oracles::Corners;
using oracles::Exact2;
using oracles::flat;
using oracles::height;
using oracles::turn;

} // namespace

TEST_CASE("vertical order: agrees with clipped polygons in rationals", "[layers]") {
    std::mt19937_64 random(21);
    int above = 0, below = 0, same = 0, apart = 0;
    for (int i = 0; i < test_support::cases(30000); ++i) {
        // There are few positions, so that corners on edges and shared edges are common; heights
        // may be equal.
        std::uniform_int_distribution<int> place(0, 2 + i % 4), level(0, i % 3 == 0 ? 2 : 9);
        const auto corner = [&](int shift) {
            return Point3{static_cast<double>(place(random)), static_cast<double>(place(random)),
                          static_cast<double>(level(random) + shift)};
        };
        const int shift = i % 5 == 0 ? 4 : 0;
        const Corners first{corner(0), corner(0), corner(0)},
            second{corner(shift), corner(shift), corner(shift)};
        const PointStore store({first[0], first[1], first[2], second[0], second[1], second[2]});
        const UpwardRounding guard;
        const auto s = seen_along_z(guard, store, {0, 1, 2}),
                   t = seen_along_z(guard, store, {3, 4, 5});
        const auto corners = [&](const UpwardTriangle& u) {
            return Corners{store.input(u[0]), store.input(u[1]), store.input(u[2])};
        };
        CHECK(s.has_value() == (turn(flat(first[0]), flat(first[1]), flat(first[2])) != 0));
        if (!s || !t) continue;
        const auto shared = common(corners(*s), corners(*t));
        const bool overlap = area(shared) > 0;
        REQUIRE(overlap_along_z(guard, store, *s, *t) == overlap);
        REQUIRE(overlap_along_z(guard, store, *t, *s) == overlap);
        if (!overlap) {
            ++apart;
            continue;
        }
        bool higher = false, lower = false;
        for (const Exact2& p : shared) {
            const mpq_class d = height(corners(*s), p) - height(corners(*t), p);
            higher = higher || d > 0;
            lower = lower || d < 0;
        }
        if (higher && lower) continue; // they cross
        const Sign expected = higher ? Sign::Positive : lower ? Sign::Negative : Sign::Zero;
        REQUIRE(above_along_z(guard, store, *s, *t) == expected);
        REQUIRE(above_along_z(guard, store, *t, *s) == -expected);
        ++(higher ? above : lower ? below : same);
    }
    CHECK(std::min({above, below, apart}) > test_support::cases(200));
    CHECK(same > 0);
}
