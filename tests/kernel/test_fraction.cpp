// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/fraction.hpp>

#include <catch2/catch.hpp>

#include <limits>

using terrane::Exact;
using terrane::fraction;

TEST_CASE("fraction (1) (2): reduced, positive denominator, /1 left out") {
    CHECK(fraction(Exact(0.0), Exact(7.0), 10) == "0");
    CHECK(fraction(Exact(-0.0), Exact(-7.0), 10) == "0");
    CHECK(fraction(Exact(10.0), Exact(-6.0), 10) == "-5/3");
    CHECK(fraction(Exact(-12.0), Exact(-4.0), 10) == "3");
    CHECK(fraction(Exact(0.5), Exact(0.75), 10) == "2/3");
    CHECK(fraction(Exact(-511.0), Exact(4.0), 16) == "-1ff/4");
}

TEST_CASE("fraction: the whole range of doubles") {
    const double smallest = std::numeric_limits<double>::denorm_min();
    const double largest = std::numeric_limits<double>::max();
    CHECK(fraction(Exact(smallest), Exact(1.0), 16) == "1/4" + std::string(268, '0'));
    CHECK(fraction(Exact(largest), Exact(largest), 10) == "1");
    CHECK(fraction(Exact(0x1p1000), Exact(0x1p-4), 16) == "1" + std::string(251, '0'));
}

TEST_CASE("fractions: of input points and of constructed ones") {
    terrane::PointStore points({{0, 0, 0.25}, {3, 0, 0.25}, {0, 1, 0.25}, {1, 1, -1}, {1, 0, 2}});
    using Kind = terrane::Construction::Kind;
    const terrane::Construction how{Kind::line_plane, terrane::Axis::x, {3, 4, 0, 1, 2}};
    points.append({&how, 1});
    CHECK(fractions(points, 3, 10) == std::array<std::string, 3>{"1", "1", "-1"});
    CHECK(fractions(points, 5, 10) == std::array<std::string, 3>{"1", "7/12", "1/4"});
}
