// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/selection.hpp>

#include <array>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/boundary_bodies.hpp"
#include "support/closed_solids.hpp"
#include "support/effort.hpp"
#include "support/winding_oracle.hpp"

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/selection/expression.hpp>

using namespace terrane;
using namespace test_support;

namespace {

Selected chosen(const std::vector<Surface>& surfaces, const std::string& expression,
                InsideRule rule = InsideRule::nonzero) {
    auto made = select(surfaces, expression, {.rule = rule, .fractions = true});
    INFO(expression);
    REQUIRE(made);
    return std::move(*made);
}

mpq_class volume_in(const std::vector<Surface>& surfaces, const std::string& expression) {
    return mpq_class(chosen(surfaces, expression).exact_volume);
}

/// Whether as many triangles run along each edge as against it.
bool is_closed(const Mesh& mesh) {
    std::map<Edge, int> sums;
    for (const Triangle& t : mesh.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const std::uint32_t u = t[i], w = t[(i + 1) % 3];
            sums[{std::min(u, w), std::max(u, w)}] += u < w ? 1 : -1;
        }
    return std::ranges::all_of(sums, [](const auto& e) { return e.second == 0; });
}

bool is_within(int winding, InsideRule rule) {
    return rule == InsideRule::nonzero    ? winding != 0
           : rule == InsideRule::positive ? winding > 0
                                          : winding % 2 != 0;
}

/// Compares a selection with the winding numbers of random points; returns how many were compared.
int compare_points(const std::vector<Surface>& surfaces, const std::string& text, InsideRule rule,
                   const Selected& made, Random& random) {
    const auto expression = parse_expression(text);
    REQUIRE(expression);
    int compared = 0;
    for (int i = 0; i < 12; ++i) {
        RationalPoint q;
        for (auto& c : q) c = mpq_class(random_int(random, -5000, 5000), 1009);
        for (auto& c : q) c.canonicalize();
        std::vector<int> windings;
        for (const Surface& s : surfaces)
            if (const auto w = winding_around(s.vertices, s.triangles, q)) windings.push_back(*w);
        const auto found = winding_around(made.mesh.vertices, made.mesh.triangles, q);
        if (windings.size() != surfaces.size() || !found) continue;
        const bool expected = expression->value([&](std::uint32_t k) {
            return is_within(
                windings[static_cast<std::size_t>(expression->operands[k].name[0] - 'a')], rule);
        });
        CHECK(*found == (expected ? 1 : 0));
        ++compared;
    }
    return compared;
}

void check_boundary(const Selected& made) {
    CHECK(made.rounding.clean);
    CHECK(conforming(made.mesh.vertices, made.mesh.triangles,
                     std::vector<std::uint32_t>(made.mesh.triangles.size())));
    CHECK(is_closed(made.mesh));
    mpq_class sum;
    for (const SelectedPiece& p : made.pieces) sum += mpq_class(p.exact_volume);
    CHECK(sum == mpq_class(made.exact_volume));
    CHECK(made.volume == Approx(sum.get_d()));
    const Surface whole{"", Role::unknown, made.mesh.vertices, made.mesh.triangles};
    CHECK(volume_of({whole}).get_d() == Approx(made.volume).margin(1e-9));
}

/// Returns a random expression over the names a, b, ...
std::string random_expression(Random& random, int names, int depth) {
    if (depth == 0 || random_int(random, 0, 4) == 0)
        return std::string(1, static_cast<char>('a' + random_int(random, 0, names - 1)));
    if (random_int(random, 0, 5) == 0) return "~" + random_expression(random, names, depth - 1);
    const char op = "|&-^"[random_int(random, 0, 3)];
    return "(" + random_expression(random, names, depth - 1) + " " + op + " " +
           random_expression(random, names, depth - 1) + ")";
}

} // namespace

TEST_CASE("select: two cubes, by each operator") {
    const std::vector<Surface> cubes{cube(0, 2, "a"), cube(1, 3, "b")};
    const std::map<std::string, std::string> volumes{{"a | b", "15"}, {"a & b", "1"},
                                                     {"a - b", "7"},  {"b - a", "7"},
                                                     {"a ^ b", "14"}, {"a", "8"}};
    for (const auto& [expression, volume] : volumes) {
        const auto made = chosen(cubes, expression);
        INFO(expression);
        CHECK(made.exact_volume == volume);
        CHECK(made.pieces.size() == (expression == "a ^ b" ? 2 : 1));
        CHECK(made.cavities == (expression == "a ^ b" ? 1 : 0)); // the cube in both
        check_boundary(made);
    }
}

TEST_CASE("select: pieces and cavities are counted") {
    const std::vector<Surface> s{cube(0, 9, "a"), cube(1, 3, "b"), cube(5, 7, "c"),
                                 box({4, -1, -1}, {5, 10, 10}, "wall")};
    CHECK(chosen(s, "a - b - c").cavities == 2);
    CHECK(chosen(s, "a - b - c").pieces.size() == 1);
    const auto cut = chosen(s, "a - wall - b");
    CHECK(cut.pieces.size() == 2);
    CHECK(cut.cavities == 1);
    CHECK(cut.pieces[0].exact_volume == "316"); // 4 * 81 - 8
    CHECK(cut.pieces[1].exact_volume == "324");
    for (std::uint32_t p = 0; p < 2; ++p) {
        const Mesh piece = cut.piece(p);
        CHECK(piece.triangles.size() == cut.pieces[p].triangles);
        CHECK(is_closed(piece));
        CHECK(volume_of({{"", Role::unknown, piece.vertices, piece.triangles}}) ==
              mpq_class(cut.pieces[p].exact_volume));
    }
    const auto nothing = chosen(s, "b & c");
    CHECK(nothing.mesh.triangles.empty());
    CHECK(nothing.exact_volume == "0");
    CHECK(nothing.pieces.empty());
}

TEST_CASE("select: rules tell what is inside of a surface that contains itself or faces inwards") {
    Surface nested = cube(0, 4, "a");
    const Surface inner = cube(1, 3);
    for (const Triangle& t : inner.triangles)
        nested.triangles.push_back({t[0] + 24, t[1] + 24, t[2] + 24});
    nested.vertices.insert(nested.vertices.end(), inner.vertices.begin(), inner.vertices.end());
    const auto volume = [&](const Surface& s, InsideRule rule) {
        return chosen({s}, "a", rule).exact_volume;
    };
    CHECK(volume(nested, InsideRule::nonzero) == "64");
    CHECK(volume(nested, InsideRule::positive) == "64");
    CHECK(volume(nested, InsideRule::odd) == "56");
    const Surface inwards = turned_over(nested);
    CHECK(volume(inwards, InsideRule::nonzero) == "64");
    CHECK(volume(inwards, InsideRule::positive) == "0");
    CHECK(volume(inwards, InsideRule::odd) == "56");
    for (const InsideRule rule : {InsideRule::nonzero, InsideRule::positive, InsideRule::odd})
        CHECK(inside_rule_named(name_of(rule)) == rule);
    CHECK(!inside_rule_named("even"));
}

TEST_CASE(
    "select: random solids agree with winding numbers of points and with inclusion-exclusion") {
    int compared = 0;
    for (int seed = 0; seed < cases(60); ++seed) {
        SolidMaker make(static_cast<std::uint64_t>(seed));
        const auto s = make.solids(2);
        INFO("seed " << seed);
        std::map<std::string, mpq_class> volume{{"a", volume_in(s, "a")}, {"b", volume_in(s, "b")}};
        for (const char* const text : {"a | b", "a & b", "a - b", "b - a", "a ^ b"}) {
            const auto made = chosen(s, text);
            INFO(text);
            check_boundary(made);
            compared += compare_points(s, text, InsideRule::nonzero, made, make.random);
            volume[text] = mpq_class(made.exact_volume);
        }
        CHECK(volume["a | b"] + volume["a & b"] == volume["a"] + volume["b"]);
        CHECK(volume["a - b"] + volume["a & b"] == volume["a"]);
        CHECK(volume["b - a"] + volume["a & b"] == volume["b"]);
        CHECK(volume["a ^ b"] == volume["a - b"] + volume["b - a"]);
    }
    CHECK(compared > 30 * cases(60));
}

TEST_CASE("select: random expressions over three and four solids agree with winding numbers") {
    constexpr std::array rules{InsideRule::nonzero, InsideRule::positive, InsideRule::odd};
    for (int seed = 0; seed < cases(60); ++seed) {
        SolidMaker make(static_cast<std::uint64_t>(seed) + 100000);
        const int count = random_int(make.random, 3, 4);
        const auto s = make.solids(count);
        const std::string text = random_expression(make.random, count, 3);
        const InsideRule rule = rules[static_cast<std::size_t>(random_int(make.random, 0, 2))];
        INFO("seed " << seed << ", " << text << ", rule " << name_of(rule));
        const auto made = select(s, text, {.rule = rule, .fractions = true});
        const auto expression = parse_expression(text);
        if (expression->value([](std::uint32_t) { return false; })) {
            REQUIRE(!made);
            CHECK(made.error().message() ==
                  "expression: the region has no end: all that is outside of "
                  "the surfaces is in it");
            continue;
        }
        REQUIRE(made);
        check_boundary(*made);
        compare_points(s, text, rule, *made, make.random);
    }
}

TEST_CASE("select: however an expression says it, the same region has the same bytes") {
    const std::vector<std::array<const char*, 2>> equal{
        {"(a | b) | c", "a | (b | c)"},
        {"(a & b) & c", "c & (b & a)"},
        {"(a ^ b) ^ c", "b ^ (c ^ a)"},
        {"a - b - c", "a - (b | c)"},
        {"a & (b | c)", "~(~a | ~b & ~c)"},
        {"a & b | a & c", "a & (b | c)"},
        {"(a | b | c) - a", "(c | b) & ~a | a & b & c & ~a"}};
    for (int seed = 0; seed < cases(16); ++seed) {
        SolidMaker make(static_cast<std::uint64_t>(seed) + 200000);
        const auto s = make.solids(3);
        INFO("seed " << seed);
        for (const auto& [one, other] : equal) {
            const auto p = chosen(s, one), q = chosen(s, other);
            INFO(one);
            CHECK(p.mesh.vertices == q.mesh.vertices);
            CHECK(p.mesh.triangles == q.mesh.triangles);
            CHECK(p.mesh.parents_of == q.mesh.parents_of);
            CHECK(p.mesh.intersection_edges == q.mesh.intersection_edges);
            CHECK(p.piece_of == q.piece_of);
        }
    }
}

TEST_CASE("select: a thousand copies of a surface are the surface") {
    std::vector<Surface> copies(1000, cube(0, 2, "a"));
    copies.push_back(cube(1, 3, "b"));
    CHECK(chosen(copies, "a - b").exact_volume == "7");
    std::string all = "b";
    for (std::size_t i = 0; i < 1000; ++i) {
        copies[i].name = "a" + std::to_string(i);
        all += " | a" + std::to_string(i);
    }
    CHECK(chosen(copies, all).exact_volume == "15");
}

TEST_CASE("select: a hull is all that a surface keeps from infinity") {
    Surface scan = cube(0, 4, "a"); // with a cube inside, faults of facing, and a flap
    const Surface inner = turned_over(cube(1, 3));
    for (const Triangle& t : inner.triangles)
        scan.triangles.push_back({t[0] + 24, t[1] + 24, t[2] + 24});
    scan.vertices.insert(scan.vertices.end(), inner.vertices.begin(), inner.vertices.end());
    for (std::size_t t = 0; t < scan.triangles.size(); t += 3)
        std::swap(scan.triangles[t][1], scan.triangles[t][2]);
    add_quad(scan, {2, 2, 2}, {2, 2, 9}, {2, 3, 9}, {2, 3, 2});
    const std::vector<Surface> s{scan, cube(3, 5, "b")};
    CHECK(!select(s, "a"));
    const auto hull = chosen(s, "hull(a)");
    CHECK(hull.exact_volume == "64");
    CHECK(hull.pieces.size() == 1);
    CHECK(hull.cavities == 0);
    check_boundary(hull);
    CHECK(chosen(s, "hull(a) & b").exact_volume == "1");
    CHECK(chosen(s, "b - hull(a)").exact_volume == "7");
    CHECK(chosen(s, "hull(a) | hull(b)").exact_volume == "71");
    auto open = s;
    open[0].triangles.erase(open[0].triangles.begin());
    CHECK(chosen(open, "hull(a)").exact_volume == "8"); // the outer cube has a hole
    CHECK(select(s, "~hull(a)").error().message().find("no end") != std::string::npos);
}

TEST_CASE("select: parents are counted through all surfaces") {
    const std::vector<Surface> s{cube(5, 6, "far"), cube(0, 2, "a"), cube(5, 6, "far2"),
                                 cube(1, 3, "b")};
    const auto made = chosen(s, "a - b");
    REQUIRE(made.mesh.surfaces.size() == 4);
    std::set<std::uint32_t> seen;
    for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t)
        for (const std::uint32_t parent : made.mesh.parents_of[t]) {
            const std::uint32_t of = parent / 12; // a cube has 12 triangles
            CHECK(std::ranges::count(made.mesh.surfaces_of[t], of) == 1);
            seen.insert(of);
        }
    CHECK(seen == std::set<std::uint32_t>{1, 3});
}

TEST_CASE("select: what is wrong with an operand is named with its place") {
    const std::vector<Surface> good{cube(0, 2, "a"), cube(1, 3, "b")};
    auto open = good;
    open[1].triangles.pop_back();
    const auto refused = select(open, "a - b");
    REQUIRE(!refused);
    CHECK(refused.error().code == ErrorCode::not_closed);
    CHECK(refused.error().message() ==
          "b: bounds no solid: it is not closed along 4 edges, first at (1, 1, 3)");
    CHECK(select(open, "a")); // b is not asked for

    auto turned = good;
    std::swap(turned[1].triangles[0][0], turned[1].triangles[0][1]);
    const auto wrong = select(turned, "b & a");
    REQUIRE(!wrong);
    CHECK(wrong.error().message() ==
          "b: bounds no solid: triangles face different ways at 5 edges, first at (1, 1, 1)");

    const auto endless = select(open, "a | ~b"); // said before any work
    REQUIRE(!endless);
    CHECK(endless.error().message() ==
          "expression: the region has no end: all that is outside of the surfaces is in it");
    CHECK(select(good, "~(~a | b)"));

    const auto unknown = select(good, "a - bb");
    REQUIRE(!unknown);
    CHECK(unknown.error().code == ErrorCode::bad_option);
    CHECK(unknown.error().message().find("no surface is called bb") != std::string::npos);
    auto twice = good;
    twice[1].name = "a";
    const auto ambiguous = select(twice, "a - a_2");
    REQUIRE(!ambiguous);
    CHECK(ambiguous.error().message() ==
          "expression: names one surface in two ways, \"a\" and \"a_2\"");
}
