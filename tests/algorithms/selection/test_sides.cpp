// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sides of open surfaces, and parts of open surfaces, judged by winding numbers of the solid beneath a surface.
#include <terrane/algorithms/selection/selection.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/closed_solids.hpp"
#include "support/effort.hpp"
#include "support/solid_beneath.hpp"
#include "support/winding_oracle.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr double bottom = -40;

/// Returns a sheet over [-20, 20]^2: heights of a coarse lattice, or an overhanging fold along y.
Surface sheet(Random& random, std::string name) {
    Surface s{std::move(name), Role::unknown, {}, {}};
    if (random_int(random, 0, 2) == 0) {
        const double high = random_int(random, 1, 4), low = random_int(random, -4, 0);
        const double to = random_int(random, 1, 4), back = random_int(random, -4, 0);
        const std::array<Point3, 4> profile{
            {{-20, 0, high}, {to, 0, high}, {back, 0, low}, {20, 0, low}}};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = [&](std::size_t k, double y) {
                return Point3{profile[k].x, y, profile[k].z};
            };
            add_quad(s, at(i, -20), at(i + 1, -20), at(i + 1, 20), at(i, 20));
        }
        return s;
    }
    constexpr int n = 8;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            s.vertices.push_back({i * 5.0 - 20, j * 5.0 - 20, double(random_int(random, -4, 4))});
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
            if (random_int(random, 0, 1) == 0) {
                s.triangles.insert(s.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
            } else {
                s.triangles.insert(s.triangles.end(), {{a, b, a + 1}, {b, b + 1, a + 1}});
            }
        }
    return s;
}

/// Turns all triangles of a sheet, or some.
Surface turned_somehow(Surface s, Random& random) {
    const int how = random_int(random, 0, 2);
    for (Triangle& t : s.triangles)
        if (how == 1 || (how == 2 && random_int(random, 0, 1) == 0)) std::swap(t[1], t[2]);
    return s;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

Selected picked(const std::vector<Surface>& surfaces, const std::string& expression) {
    auto made = select(surfaces, expression, {.fractions = true});
    INFO(expression << ": " << (made ? "" : made.error().message()));
    REQUIRE(made);
    CHECK(made->rounding.clean);
    return std::move(*made);
}

std::vector<Point3> places(const Mesh& mesh) {
    auto sorted = mesh.vertices;
    std::ranges::sort(sorted);
    return sorted;
}

/// Checks that sides of the sheets t and s select what the solids beneath them do.
void compare(const std::vector<Surface>& with_sheets, const std::vector<Surface>& with_solids,
             const std::string& text) {
    std::string other = text;
    for (const std::string name : {"t", "s"}) {
        other = replaced(other, "below(" + name + ")", "inside(" + name + ")");
        other = replaced(other, "above(" + name + ")", "~inside(" + name + ")");
    }
    INFO(text);
    const auto made = picked(with_sheets, text), expected = picked(with_solids, other);
    CHECK(made.exact_volume == expected.exact_volume);
    CHECK(made.pieces.size() == expected.pieces.size());
    CHECK(made.cavities == expected.cavities);
    CHECK(made.is_surface == expected.is_surface);
    CHECK(places(made.mesh) == places(expected.mesh));
    CHECK(made.mesh.triangles.size() == expected.mesh.triangles.size());
}

std::string refusal(const std::vector<Surface>& surfaces, const std::string& expression) {
    const auto made = select(surfaces, expression);
    REQUIRE(!made);
    return made.error().message();
}

} // namespace

TEST_CASE("select: what is below a surface is what the solid beneath it has") {
    for (int seed = 0; seed < cases(80); ++seed) {
        SolidMaker make(static_cast<std::uint64_t>(seed) + 300000);
        INFO("seed " << seed);
        auto all = make.solids(2);
        const Surface t = sheet(make.random, "t"), s = sheet(make.random, "s");
        auto solids = all;
        solids.insert(solids.end(), {beneath(t, bottom, "t"), beneath(s, bottom, "s")});
        all.insert(all.end(), {turned_somehow(t, make.random), turned_somehow(s, make.random)});
        for (const char* const text :
             {"a & below(t)", "a & above(t)", "(a | b) & below(t)", "(a - b) & above(t)",
              "a & below(t) | b & above(t)", "(a ^ b) - below(t)", "(a | b) & below(t) & above(s)",
              "a & (below(t) ^ below(s)) | b & below(s)"})
            compare(all, solids, text);
    }
}

TEST_CASE("select: sides along other axes are sides below in a turned model") {
    for (int seed = 0; seed < cases(24); ++seed) {
        SolidMaker make(static_cast<std::uint64_t>(seed) + 400000);
        INFO("seed " << seed);
        auto all = make.solids(2);
        all.push_back(turned_somehow(sheet(make.random, "t"), make.random));
        const std::string below = picked(all, "(a | b) & below(t)").exact_volume,
                          above = picked(all, "(a | b) & above(t)").exact_volume;
        for (const auto& [low, high] : {std::pair{"west", "east"}, std::pair{"south", "north"}}) {
            for (Surface& one : all) // x, y, z become y, z, x
                for (Point3& p : one.vertices) p = {p.z, p.x, p.y};
            CHECK(picked(all, std::string("(a | b) & ") + low + "(t)").exact_volume == below);
            CHECK(picked(all, std::string("(a | b) & ") + high + "(t)").exact_volume == above);
        }
    }
}

TEST_CASE("select: parts of open surfaces are those on a side, or inside of solids") {
    for (int seed = 0; seed < cases(60); ++seed) {
        SolidMaker make(static_cast<std::uint64_t>(seed) + 500000);
        INFO("seed " << seed);
        auto all = make.solids(2);
        all.push_back(sheet(make.random, "f"));
        const bool is_steep = random_int(make.random, 0, 1) == 0;
        for (Point3& p : all.back().vertices) // it ends where neither t nor s do
            p = is_steep ? Point3{p.z, p.x / 2, p.y / 2} : Point3{p.x / 2, p.y / 2, p.z};
        const Surface t = sheet(make.random, "t"), s = sheet(make.random, "s");
        auto solids = all;
        solids.insert(solids.end(), {beneath(t, bottom, "t"), beneath(s, bottom, "s")});
        all.insert(all.end(), {turned_somehow(t, make.random), turned_somehow(s, make.random)});
        for (const char* const text :
             {"f & below(t)", "f - below(t)", "f & below(t) & above(s)", "f & below(t) & inside(a)",
              "f - inside(a) & above(s) | f & inside(b)"})
            compare(all, solids, text);
    }
}

TEST_CASE("select: points of an open surface are in the part that winding numbers say") {
    int compared = 0;
    for (int seed = 0; seed < cases(60); ++seed) {
        SolidMaker make(static_cast<std::uint64_t>(seed) + 600000);
        INFO("seed " << seed);
        auto all = make.solids(2);
        all.push_back(sheet(make.random, "f"));
        const Surface& f = all[2];
        const auto first =
            static_cast<std::uint32_t>(all[0].triangles.size() + all[1].triangles.size());
        const auto made = picked(all, "f & inside(a) - inside(b)");
        CHECK(made.is_surface);
        for (std::uint32_t p = 0; p < f.triangles.size(); ++p) {
            const std::array<Point3, 3> c{f.vertices[f.triangles[p][0]],
                                          f.vertices[f.triangles[p][1]],
                                          f.vertices[f.triangles[p][2]]};
            const mpq_class u(random_int(make.random, 1, 500), 1009),
                v(random_int(make.random, 1, 500), 1013);
            const auto at = [&](double Point3::*k) {
                return mpq_class(c[0].*k + u * (c[1].*k - c[0].*k) + v * (c[2].*k - c[0].*k));
            };
            const RationalPoint q{at(&Point3::x), at(&Point3::y), at(&Point3::z)};
            const auto a = winding_around(all[0].vertices, all[0].triangles, q),
                       b = winding_around(all[1].vertices, all[1].triangles, q);
            if (!a || !b) continue;
            bool is_in = false; // of a triangle of this parent, seen from above; none is vertical
            for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
                if (std::ranges::count(made.mesh.parents_of[t], first + p) == 0) continue;
                std::array<RationalPoint, 3> d;
                for (unsigned i = 0; i < 3; ++i)
                    d[i] = between(made.mesh.vertices[made.mesh.triangles[t][i]], q);
                const RationalPoint axis{0, 0, 1};
                const int x = sgn(determinant(axis, d[0], d[1])),
                          y = sgn(determinant(axis, d[1], d[2])),
                          z = sgn(determinant(axis, d[2], d[0]));
                is_in = is_in || (x != 0 && x == y && y == z);
            }
            CHECK(is_in == (*a != 0 && *b == 0));
            ++compared;
        }
    }
    CHECK(compared > 40 * cases(60));
}

TEST_CASE("select: a part that does not touch a surface is on the side where it lies") {
    const std::vector<Surface> s{cube(0, 2, "a"), box({0, 0, -9}, {1, 1, -8}, "deep"),
                                 box({0, 0, 8}, {1, 1, 9}, "high"), level(1, -3, -3, 5, 5, "t")};
    CHECK(picked(s, "(a | deep | high) & below(t)").exact_volume == "5");
    CHECK(picked(s, "(a | deep | high) & above(t)").exact_volume == "5");
    CHECK(picked(s, "deep & below(t)").exact_volume == "1");
    CHECK(picked(s, "deep & above(t)").pieces.empty());
    // Surfaces that share a border only: t hangs from that of f.
    const std::vector<Surface> hinge{level(1, 0, 0, 4, 4, "f"),
                                     quad({0, 0, 1}, {0, 4, 1}, {4, 4, 0}, {4, 0, 0}, "t")};
    CHECK(picked(hinge, "f & above(t)").mesh.triangles.size() == 2);
    CHECK(picked(hinge, "f & below(t)").mesh.triangles.empty());
    CHECK(picked(hinge, "t & below(f)").mesh.triangles.size() == 2);
}

TEST_CASE("select: a part that reaches round the end of a surface is on no side of it") {
    const std::vector<Surface> arms{box({0, 0, -3}, {10, 4, -1}, "a"),
                                    box({8, 0, -3}, {10, 4, 3}, "b"),
                                    box({0, 0, 1}, {10, 4, 3}, "c")};
    const Mesh round = picked(arms, "a | b | c").mesh;
    for (const bool divides_below : {false, true}) // many triangles on one side
        for (const bool reversed : {false, true}) {
            Surface body{"body", Role::unknown, round.vertices, round.triangles};
            for (unsigned k = 0; k < 4; ++k) {
                const auto before = std::exchange(body.triangles, {});
                for (const auto& [i, j, l] : before) {
                    const auto &p = body.vertices[i], &q = body.vertices[j], &r = body.vertices[l];
                    if (p.z != q.z || p.z != r.z || p.z != (divides_below ? -1 : 1)) {
                        body.triangles.push_back({i, j, l});
                        continue;
                    }
                    const auto middle = static_cast<std::uint32_t>(body.vertices.size());
                    body.vertices.push_back({(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3, p.z});
                    body.triangles.insert(body.triangles.end(),
                                          {{i, j, middle}, {j, l, middle}, {l, i, middle}});
                }
            }
            if (reversed) std::reverse(body.triangles.begin(), body.triangles.end());
            const std::vector<Surface> s{body, level(0, 1, 1, 3, 3, "t")};
            for (const char* side : {"below", "above"})
                CHECK(refusal(s, "body & " + std::string(side) + "(t)")
                          .find("t: does not divide the part at") == 0);
        }
    // Small triangles beside large ones: no middle of the one is within the other.
    const std::vector<Surface> s{box({0, 0, -90}, {90, 90, -80}, "deep"),
                                 level(0, 1, 80, 2, 81, "t")};
    CHECK(picked(s, "deep & below(t)").exact_volume == "81000");
    CHECK(picked(s, "deep & above(t)").pieces.empty());
}

TEST_CASE("select: a part that only borders on lines through a surface is on no side of it") {
    const std::vector<Surface> s{level(0, 0, 0, 4, 4, "t"), box({1, 4, -3}, {2, 5, -2}, "north"),
                                 box({1, -1, -3}, {2, 0, -2}, "south"),
                                 box({4, 1, -3}, {5, 2, -2}, "east"),
                                 box({-1, 1, -3}, {0, 2, -2}, "west")};
    for (const std::string body : {"north", "south", "east", "west"})
        CHECK(refusal(s, "\"" + body + "\" & below(t)").find("is neither below nor above it") !=
              std::string::npos);
}

TEST_CASE("select: what lies on a boundary is inside, what lies on a surface is below it") {
    const std::vector<Surface> s{cube(0, 2, "a"), level(0, -1, -1, 3, 3, "f"),
                                 level(0, 0, 0, 1, 1, "t")};
    const auto area = [](const Selected& made) {
        double twice = 0;
        for (const auto& [i, j, k] : made.mesh.triangles) {
            const auto& v = made.mesh.vertices;
            twice += (v[j].x - v[i].x) * (v[k].y - v[i].y) - (v[k].x - v[i].x) * (v[j].y - v[i].y);
        }
        return twice / 2;
    };
    CHECK(area(picked(s, "f & inside(a)")) == 4);
    CHECK(area(picked(s, "f - inside(a)")) == 12);
    CHECK(area(picked(s, "t & below(f)")) == 1);
    const auto none = picked(s, "t & above(f)");
    CHECK(none.is_surface);
    CHECK(none.mesh.triangles.empty());
}

TEST_CASE("select: an open surface that ends inside a part is named with the place") {
    const std::vector<Surface> s{cube(0, 2, "a"), level(1, -1, -1, 1, 3, "short"),
                                 quad({1, -1, -1}, {1, 3, -1}, {1, 3, 3}, {1, -1, 3}, "wall"),
                                 level(9, 5, 5, 6, 6, "far"), box({0.5, 0.5, -2}, {1, 1, 4}, "b")};
    CHECK(refusal(s, "a & below(short)") ==
          "short: does not divide the part at (0, 0, 1), which is on both sides of it");
    CHECK(refusal(s, "a & above(far)") ==
          "far: the part at (0, 0, 2) is neither below nor above it");
    CHECK(refusal(s, "a & below(wall)") ==
          "wall: the part at (0, 0, 2) is neither below nor above it");
    CHECK(refusal(s, "below(wall)") == "expression: the region has no end: all that is outside of "
                                       "the surfaces is in it");
    CHECK(picked(s, "a & inside(b) & below(short)").exact_volume == "1/4"); // there it does
    CHECK(picked(s, "a & west(wall)").exact_volume == "4");
    CHECK(refusal(s, "wall & below(far)").find("neither below nor above") != std::string::npos);
    const std::vector<Surface> half{level(0, 0, 0, 4, 4, "t"),
                                    quad({1, 1, -1}, {3, 1, -1}, {6, 1, 1}, {1, 1, 1}, "f")};
    CHECK(refusal(half, "f & below(t)").find("on both sides of it") != std::string::npos);
}

TEST_CASE("select: what an expression asks of sides has limits") {
    std::vector<Surface> s{cube(0, 2, "a")};
    std::string text = "a";
    for (int i = 0; i < 11; ++i) {
        s.push_back(level(1, -1, -1, 3, 3, "t" + std::to_string(i)));
        if (i < 10) text += " & below(t" + std::to_string(i) + ")";
    }
    CHECK(picked(s, text).exact_volume == "4");
    CHECK(refusal(s, text + " & below(t10)") ==
          "expression: names the sides of more than 10 surfaces");
    CHECK(refusal(s, "a & below(b)").find("no surface is called b") != std::string::npos);
    CHECK(refusal(s, "a | below(t0)").find("has no end") != std::string::npos);
}

TEST_CASE("select: surfaces divide together if the expression names both") {
    Surface t = level(1, -1, -1, 1, 3, "t"); // a fault moves it by a half
    add_quad(t, {1, -1, 0.5}, {3, -1, 0.5}, {3, 3, 0.5}, {1, 3, 0.5});
    const std::vector<Surface> s{cube(0, 2, "a"), t,
                                 quad({1, -1, -1}, {1, 3, -1}, {1, 3, 3}, {1, -1, 3}, "f")};
    CHECK(refusal(s, "a & below(t)").find("on both sides of it") != std::string::npos);
    CHECK(picked(s, "a & below(t) & (west(f) | east(f))").exact_volume == "3");
    CHECK(picked(s, "a & below(t) & west(f)").exact_volume == "2");
    CHECK(picked(s, "a & above(t) & east(f)").exact_volume == "3");
}

TEST_CASE("select: only a name without a function, beside functions, may be an open surface") {
    const std::vector<Surface> s{cube(0, 2, "a"), level(1, -1, -1, 3, 3, "t"), cube(1, 3, "b")};
    for (const char* const text : {"t", "t & a", "a - t", "inside(t) & below(t)",
                                   "t & a & inside(b)", "t | inside(a)", "t ^ inside(a)"})
        CHECK(refusal(s, text).find("t: bounds no solid: it is not closed along ") == 0);
    CHECK(picked(s, "t & inside(a)").is_surface);
    CHECK(!picked(s, "a & inside(b)").is_surface);
    CHECK(picked(s, "inside(a) & t & ~inside(b)").is_surface);
}
