// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Simple polygons, judged in integers by the definition.
#include <terrane/algorithms/tetrahedra/detail/outline.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"

using namespace terrane;
using namespace terrane::tetrahedra::detail;
using namespace test_support;

namespace {

struct Lattice {
    long x, y;

    friend bool operator==(const Lattice&, const Lattice&) = default;
};

long turn(const Lattice& a, const Lattice& b, const Lattice& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_on(const Lattice& p, const Lattice& a, const Lattice& b) {
    return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
           std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

int sign(long n) {
    return n > 0 ? 1 : n < 0 ? -1 : 0;
}

bool meet(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
    if (is_on(c, a, b) || is_on(d, a, b) || is_on(a, c, d) || is_on(b, c, d)) return true;
    return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 &&
           sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

bool is_simple(const std::vector<Lattice>& polygon) {
    const std::size_t n = polygon.size();
    const auto at = [&](std::size_t i) { return polygon[i % n]; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            if (j == i + 1 || (i == 0 && j == n - 1)) {
                const std::size_t first = j == i + 1 ? i : j;
                const Lattice a = at(first), b = at(first + 1), c = at(first + 2);
                if (is_on(a, b, c) || is_on(c, a, b)) return false;
            } else if (meet(at(i), at(i + 1), at(j), at(j + 1))) {
                return false;
            }
        }
    return true;
}

/// The polygon in space, such that its projection along the axis is the one in the plane.
std::vector<Point3> in_space(const std::vector<Lattice>& polygon, Axis axis, Random& random) {
    std::vector<Point3> points;
    for (const auto& [x, y] : polygon) {
        const auto u = static_cast<double>(x), v = static_cast<double>(y);
        const double w = random_real(random, -1, 1);
        points.push_back(axis == Axis::x   ? Point3{w, u, v}
                         : axis == Axis::y ? Point3{v, w, u}
                                           : Point3{u, v, w});
    }
    return points;
}

} // namespace

TEST_CASE("outline: polygons on a lattice are simple or not, by the definition", "[tetrahedra]") {
    Random random(7);
    int simple = 0, crossing = 0;
    for (int i = 0; i < cases(20000); ++i) {
        std::vector<Lattice> polygon(static_cast<std::size_t>(random_int(random, 3, 7)));
        const int size = random_int(random, 2, 5);
        for (std::size_t k = 0; k < polygon.size(); ++k) do // consecutive corners differ
                polygon[k] = {random_int(random, -size, size), random_int(random, -size, size)};
            while ((k > 0 && polygon[k] == polygon[k - 1]) ||
                   (k + 1 == polygon.size() && polygon[k] == polygon[0]));
        const Axis axis = std::array{Axis::x, Axis::y, Axis::z}[static_cast<std::size_t>(i % 3)];
        const auto points = in_space(polygon, axis, random);
        std::vector<std::uint32_t> corners(points.size());
        std::iota(corners.begin(), corners.end(), 0U);
        const bool expected = is_simple(polygon);
        ++(expected ? simple : crossing);
        std::string text;
        for (const auto& [x, y] : polygon)
            text += " " + std::to_string(x) + "," + std::to_string(y);
        INFO(text);
        REQUIRE(crossing_of(corners, points, axis).has_value() != expected);
    }
    CHECK(simple > cases(20000) / 20);
    CHECK(crossing > cases(20000) / 4);
}
