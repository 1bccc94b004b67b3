// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/fuzzing/minimise.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <map>
#include <unistd.h>

using namespace terrane::fuzzing;

namespace {

Soup two_solids() {
    const std::vector<std::uint8_t> string{0,   7,   6,   5,  0,    90,   10,   255,
                                           255, 255, 255, 10, 0x77, 0x19, 0x3e, 0xff};
    Bytes bytes(string.data(), string.size());
    return solids(bytes, 1000).operands;
}

bool is_closed(const Part& part) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : part.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            ++edges[{t[i], t[(i + 1) % 3]}];
            --edges[{t[(i + 1) % 3], t[i]}];
        }
    for (const auto& [edge, surplus] : edges)
        if (surplus != 0) return false;
    return !edges.empty();
}

double six_volumes(const Part& part) {
    double sum = 0;
    for (const Triangle& t : part.triangles) {
        const Point &a = part.points[t[0]], &b = part.points[t[1]], &c = part.points[t[2]];
        sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
               a.z * (b.x * c.y - b.y * c.x);
    }
    return sum;
}

} // namespace

TEST_CASE("minimise: triangles go, numbers become simple, parts stay") {
    Soup soup = two_solids();
    REQUIRE(triangle_count(soup) > 60);
    soup[1].points[0] = {1234.5678, 17.25, -3e-7};
    const auto fails = [](const Soup& s) {
        for (const Triangle& t : s[1].triangles)
            if (s[1].points[t[0]].x > 1000) return true;
        return false;
    };
    if (!fails(soup)) soup[1].triangles.push_back({0, 1, 2});
    const Soup least = minimise(soup, fails);
    REQUIRE(least.size() == 2);
    CHECK(least[0] == Part{});
    CHECK(least[1].triangles.size() == 1);
    REQUIRE(!least[1].points.empty());
    for (const Point& p : least[1].points) {
        CHECK((p.x == 0 || p.x == 1200));
        CHECK(p.y == 0);
        CHECK(p.z == 0);
    }
}

TEST_CASE("minimise: contracting edges keeps a closed part closed") {
    const Soup soup = two_solids();
    std::size_t calls = 0;
    const auto fails = [&](const Soup& s) {
        ++calls;
        return is_closed(s[0]) && is_closed(s[1]) && six_volumes(s[0]) > 0 && six_volumes(s[1]) > 0;
    };
    REQUIRE(fails(soup));
    const Soup least = minimise(soup, fails);
    CHECK(least[0].triangles.size() == 4);
    CHECK(least[1].triangles.size() == 4);
    CHECK(least[0].points.size() == 4);
    CHECK(calls < 20'000);
    for (const Part& part : least)
        for (const Point& p : part.points)
            for (const double x : {p.x, p.y, p.z}) CHECK((x == 0 || x == 1 || x == -1));
}

TEST_CASE("minimise: one of several closed pieces that share an edge goes as a whole") {
    Soup soup(1);
    for (const double y : {1., 2., 3.})
        add_tetrahedron(soup[0], {{{0, 0, 0}, {0, 0, 1}, {0, y, 0}, {-1, y, 0}}});
    Part& part = soup[0]; // the edge of the first piece is that of all
    for (Triangle& t : part.triangles)
        for (std::uint32_t& v : t)
            if (v % 4 < 2) v %= 4;
    const auto fails = [](const Soup& s) {
        auto one_sided = s[0].triangles; // no triangle is there from both sides
        for (Triangle& t : one_sided) std::sort(t.begin(), t.end());
        std::sort(one_sided.begin(), one_sided.end());
        return is_closed(s[0]) &&
               std::adjacent_find(one_sided.begin(), one_sided.end()) == one_sided.end();
    };
    REQUIRE(fails(soup));
    CHECK(minimise(soup, fails)[0].triangles.size() == 4);
}

TEST_CASE("minimise: a number becomes simpler everywhere, or in one place") {
    Soup soup(1);
    add_triangle(soup[0], {{{5.25, 0, 0}, {5.25, 1, 0}, {7.5, 0, 1}}});
    const auto x_of = [](const Soup& s, std::size_t v) { return s[0].points[v].x; };
    const auto has_corners = [](const Soup& s) { return s[0].points.size() == 3; };
    const Soup equal = minimise(soup, [&](const Soup& s) {
        return has_corners(s) && x_of(s, 0) == x_of(s, 1) && x_of(s, 2) == 7.5;
    });
    CHECK(x_of(equal, 0) == 0);
    const Soup fixed = minimise(soup, [&](const Soup& s) {
        return has_corners(s) && x_of(s, 0) == 5.25 && x_of(s, 2) == 7.5;
    });
    CHECK(x_of(fixed, 1) == 0);
}

TEST_CASE("minimise: points that no triangle has go, but for those that matter") {
    Soup soup(1);
    for (double x = 0; x < 40; ++x) add_triangle(soup[0], {{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}});
    soup[0].points.push_back({9, 9, 9}); // unused
    const auto has_unused = [](const Soup& s) {
        std::vector<bool> used(s[0].points.size());
        for (const Triangle& t : s[0].triangles)
            for (const auto v : t) used[v] = true;
        return std::count(used.begin(), used.end(), false) > 0;
    };
    const Soup least = minimise(soup, has_unused);
    CHECK(least[0].triangles.empty());
    CHECK(least[0].points == std::vector<Point>{{0, 0, 0}});
    const auto two = [](const Soup& s) { return triangle_count(s) >= 2; };
    CHECK(minimise(soup, two)[0].points.size() <= 6);
}

TEST_CASE("minimise: as many triangles remain as it takes") {
    const auto fails = [](const Soup& s) { return triangle_count(s) >= 3; };
    CHECK(triangle_count(minimise(two_solids(), fails)) == 3);
}

TEST_CASE("minimise: a mesh far away that must stay exactly as it is comes to the origin") {
    Soup soup(1);
    const double far = 0x1p36 + 50;
    add_triangle(soup[0], {{{far, far, far}, {far + 3, far, far}, {far, far + 7, far + 1}}});
    const auto fails = [](const Soup& s) { // the differences are as they were, to a power of two
        if (triangle_count(s) != 1 || s[0].points.size() != 3) return false;
        const auto& p = s[0].points;
        const double unit = p[2].z - p[0].z;
        return unit > 0 && p[1].x - p[0].x == 3 * unit && p[1].y == p[0].y && p[1].z == p[0].z &&
               p[2].x == p[0].x && p[2].y - p[0].y == 7 * unit;
    };
    REQUIRE(fails(soup));
    CHECK(minimise(soup, fails)[0].points == std::vector<Point>{{0, 0, 0}, {3, 0, 0}, {0, 7, 1}});
}

TEST_CASE("minimise: a process of its own tells failures, crashes and hangs from success") {
    CHECK_FALSE(fails_apart([] { return true; }, 10));
    CHECK(fails_apart([] { return false; }, 10));
    CHECK(fails_apart([]() -> bool { std::abort(); }, 10));
    CHECK(fails_apart([]() -> bool { throw 1; }, 10));
    const auto before = std::signal(SIGABRT, [](int) { _exit(0); });
    CHECK(fails_apart([]() -> bool { std::abort(); }, 10)); // whatever handler there is
    std::signal(SIGABRT, before);
    CHECK(fails_apart(
        [] {
            for (;;) pause();
            return true;
        },
        1));
}
