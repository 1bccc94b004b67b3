// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/collapsed_triangles.hpp>

#include "support/claim.hpp"
#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"
#include "support/soup_laws.hpp"

#include <catch2/catch.hpp>

#include <terrane/algorithms/intersection/intersection.hpp>

#include <limits>
#include <span>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

/// Returns twice the area of a triangle in the plane z = 0.
double twice_area(std::span<const Point3> points, const Triangle& t) {
    const Point3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

TEST_CASE("rounding: a triangle is divided at points inside all its sides") {
    const std::vector<Point3> points{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {2, 0, 0}, {4, 0, 0},
                                     {4, 2, 0}, {3, 3, 0}, {1, 5, 0}, {0, 3, 0}};
    const PointsInSides all{{{3, 4}, {5, 6, 7}, {8}}};
    for (unsigned sides = 0; sides < 8; ++sides) {
        PointsInSides within;
        std::size_t count = 1;
        for (unsigned i = 0; i < 3; ++i)
            if ((sides >> i & 1) != 0) count += (within[i] = all[i]).size();
        std::vector<Triangle> parts;
        divide_at({0, 1, 2}, within, parts);
        CHECK(parts.size() == count);
        double area = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            CHECK(twice_area(points, parts[i]) > 0);
            area += twice_area(points, parts[i]);
            for (std::size_t j = 0; j < i; ++j)
                CHECK_FALSE(improper_contact(points, parts[i], parts[j]));
        }
        CHECK(area == 36);
    }
}

TEST_CASE("rounding: a sliver that becomes a line opens no slit between its neighbours") {
    const double least = std::numeric_limits<double>::denorm_min();
    const std::vector model{
        surface({{-1, -2, -1 - 0x1p-52}, {-1, 0, 0}, {0, 0, 0}}, {{0, 1, 2}}),
        surface(
            {{-1, -0.5, 0}, {0, -0.5, 0}, {0, 0.5, -1}, {least, least, -1}, {-1, -2, 0}, {0, 0, 0}},
            {{0, 1, 2}, {3, 4, 5}})};
    const auto a = arranged(model);
    const auto r = rounded(a);
    CHECK(r.report.collapsed_triangles == 1);
    CHECK(r.report.clean);
    CHECK(r.report.rounds == 0); // nothing meets improperly except the sliver's corner
    for (const unsigned rounds : {8U, 1U, 0U})
        CHECK(soup_laws::rounding_flaw(model, a, {.max_rounds = rounds}).empty());
}
