// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// Squares of size 1 with two triangles each, from (x0, y0) to (x1, y1) at height z.
Surface tiled_level(double z, double x0, double x1, double y0, double y1, std::string name) {
    Surface s{std::move(name), Role::horizon, {}, {}};
    const auto count = [](double a, double b) { return std::max(1, int(std::ceil(b - a))); };
    const int m = count(x0, x1), n = count(y0, y1);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < m; ++i) {
            const double a = x0 + i, b = std::min(a + 1, x1), c = y0 + j, d = std::min(c + 1, y1);
            add_quad(s, {a, c, z}, {b, c, z}, {b, d, z}, {a, d, z});
        }
    return s;
}

struct Judged {
    Arranged arranged;
    terrane::Model model;
    LeakAdvice advice;
};

Judged judged(const std::vector<Surface>& surfaces) {
    auto arranged = arrange_within(surfaces, {});
    REQUIRE(arranged);
    REQUIRE(arranged->rounded.conforming);
    auto model = make_model(arranged->exact, *arranged->rounded.conforming);
    REQUIRE(model);
    auto advice = judge_leaks(*arranged, model->borders);
    REQUIRE(advice);
    CHECK(advice->verdicts.size() == leaks_of(model->borders).size());
    return {std::move(*arranged), std::move(*model), std::move(*advice)};
}

std::ptrdiff_t count(const LeakAdvice& advice, LeakVerdict verdict) {
    return std::ranges::count(advice.verdicts, verdict);
}

} // namespace

TEST_CASE("leaks: a horizon that stops short of a side separates, a tip does not", "[leaks]") {
    // The level ends 0.01 before the side of the box at x = 8. The small one ends as near to it,
    // but far from the others.
    const auto box_of_eight = box({0, 0, 0}, {8, 8, 8}, "box");
    const auto one = judged({box_of_eight, tiled_level(3, -1, 7.99, -1, 9, "top"),
                             tiled_level(5, 5, 7.99, 2, 5, "tip")});
    CHECK(one.model.block_count() == 1);
    CHECK(one.advice.distance > 0.01);
    CHECK(one.advice.distance < 0.2);
    REQUIRE(one.advice.separating.size() == 1);
    const Leak& leak = one.advice.separating.front();
    CHECK(one.model.mesh->surfaces[leak.from].name == "top");
    CHECK(one.model.mesh->surfaces[leak.to].name == "box");
    CHECK(leak.least == Approx(0.01));
    CHECK(leak.largest == Approx(0.01));
    CHECK(count(one.advice, LeakVerdict::separates) == 1);
    CHECK(count(one.advice, LeakVerdict::harmless) == 1); // the side of the tip at the box
    CHECK(count(one.advice, LeakVerdict::wide) > 0);      // its other sides
}

TEST_CASE("leaks: a gap beside a wide opening separates nothing", "[leaks]") {
    // The level ends near one side, and far from the opposite one.
    const auto two =
        judged({box({0, 0, 0}, {8, 8, 8}, "box"), tiled_level(3, 2, 7.99, -1, 9, "top")});
    CHECK(two.advice.separating.empty());
    CHECK(count(two.advice, LeakVerdict::separates) == 0);
    CHECK(count(two.advice, LeakVerdict::harmless) == 1);
}

TEST_CASE("leaks: none, or sealed", "[leaks]") {
    const auto closed = judged({cube(0, 4)});
    CHECK(closed.advice.distance == 0);
    CHECK(closed.advice.verdicts.empty());
    auto sealed = closed.arranged;
    sealed.sealed = SealReport{};
    const auto refused = judge_leaks(sealed, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::bad_option);
}
