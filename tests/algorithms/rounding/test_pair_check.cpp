// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/effort.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/rounding/detail/pair_decisions.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/verify/verify.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace terrane;
using namespace test_support;

namespace {

constexpr RoundingOptions counting{.check = {PairCheck::bounds, SIZE_MAX}};
constexpr RoundingOptions full{.check = {PairCheck::full, SIZE_MAX}};

/// Pairs of triangles whose boxes overlap, one by one.
std::uint64_t overlapping_pairs(const Mesh& m) {
    std::vector<Box> boxes;
    for (const Triangle& t : m.triangles) boxes.push_back(box_of(m.vertices, t));
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) count += boxes[i].overlaps(boxes[j]);
    return count;
}

std::uint64_t not_apart(const PairCounts& c) {
    return c.tested + c.in_patches + c.separated + c.unmoved;
}

void check_laws(const Mesh& m, const PairCounts& counts) {
    const std::uint64_t n = m.triangles.size();
    CHECK(not_apart(counts) + counts.apart == n * (n - 1) / 2); // law (1)
    CHECK(not_apart(counts) == overlapping_pairs(m));           // law (2)
}

/// A wavy sheet and planes across it at odd angles.
std::vector<Surface> crossed_sheets(unsigned n) {
    std::vector<Surface> model{unit_grid(n, n, [](double x, double y) {
        return Point3{x, y, 0.07 * std::sin(5 * x) + 0.05 * std::cos(7 * y)};
    })};
    for (const double at : {0.31, 0.52, 0.83})
        model.push_back(unit_grid(n / 2, n / 2, [at](double x, double y) {
            return Point3{at + 0.1 * y + 0.03 * x, 0.1 + 0.77 * x, y - 0.45};
        }));
    return model;
}

/// Two sheets in nearly one plane: many pairs meet improperly once they are in doubles.
std::vector<Surface> nearly_coplanar(unsigned n) {
    const double h = 0.5 / n;
    const auto turned = [](double x, double y) {
        return Point3{0.9 * x - 0.3 * y + 0.1, 0.2 * x + 0.8 * y, 0.37 * x - 0.41 * y + 0.2};
    };
    return {unit_grid(n, n, turned),
            unit_grid(n, n, [&](double x, double y) { return turned(x + h, y + h); })};
}

std::vector<Surface> random_soup(std::mt19937& random) {
    std::uniform_real_distribution<double> at(0, 1);
    const auto point = [&] { return Point3{at(random), at(random), at(random)}; };
    std::vector<Surface> model(2);
    for (Surface& s : model)
        for (std::uint32_t k = 0; k < 8; ++k) {
            for (int i = 0; i < 3; ++i) s.vertices.push_back(point());
            s.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
        }
    return model;
}

/// Two surfaces of triangles that are nearly in one plane, at random.
std::vector<Surface> nearly_coplanar_soup(std::mt19937& random) {
    const double flat = std::ldexp(1, -30 - static_cast<int>(random() % 20));
    std::uniform_real_distribution<double> at(0, 1), off(-flat, flat);
    std::vector<Surface> model(2);
    for (Surface& s : model)
        for (std::uint32_t k = 0; k < 4; ++k) {
            for (int i = 0; i < 3; ++i) {
                const double x = at(random), y = at(random);
                s.vertices.push_back({x, y, 0.3 * x + 0.2 * y + off(random)});
            }
            s.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
        }
    return model;
}

/// Two planes. In each, enough triangles overlap for the arrangement to pool them.
std::vector<Surface> pooled_soup(std::mt19937& random) {
    std::uniform_real_distribution<double> at(0, 1);
    std::vector<Surface> model(2);
    for (std::size_t s = 0; s < model.size(); ++s)
        for (std::uint32_t k = 0; k < 48; ++k) {
            for (int i = 0; i < 3; ++i) {
                const double x = at(random), y = at(random);
                model[s].vertices.push_back({x, y, s == 0 ? x : y});
            }
            model[s].triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
        }
    return model;
}

/// So many triangles at one vertex that it is crowded, nearly in one plane; the others hardly cross
/// them if they are few.
std::vector<Surface> crowded_soup(std::mt19937& random, bool overlapping) {
    const double flat = std::ldexp(1, -30 - static_cast<int>(random() % 20));
    std::uniform_real_distribution<double> at(0.1, 1), off(-flat, flat);
    std::vector<Surface> model(1);
    model[0].vertices.push_back({0, 0, 0});
    const auto add = [&](double x, double y) {
        model[0].vertices.push_back({x, y, 0.3 * x + 0.2 * y + off(random)});
    };
    for (std::uint32_t k = 0; k < 130; ++k) {
        const double x = at(random), y = at(random);
        add(x, y);
        if (overlapping)
            add(x + 0.8 * at(random), y); // few parts, but more than a quarter of the pairs
        else
            add(x + 1e-4, y);
        model[0].triangles.push_back({0, 2 * k + 1, 2 * k + 2});
    }
    return model;
}

/// A line between points of integer coordinates.
using Line = std::array<std::array<double, 2>, 2>;

/// Returns three lines that cross in pairs. Their crossings are the corners of a small triangle. It
/// turns over if its corners are rounded to multiples of `spacing_of_doubles`.
std::array<Line, 3> nearly_concurrent(std::mt19937& random, double spacing_of_doubles) {
    using Corner = std::array<double, 2>;
    const auto at = [&] { return 300.0 + random() % 50; };
    const auto crossing = [](const Line& l, const Line& m) -> Corner {
        const double ux = l[1][0] - l[0][0], uy = l[1][1] - l[0][1], vx = m[1][0] - m[0][0],
                     vy = m[1][1] - m[0][1];
        const double s =
            ((m[0][0] - l[0][0]) * vy - (m[0][1] - l[0][1]) * vx) / (ux * vy - uy * vx);
        return {l[0][0] + s * ux, l[0][1] + s * uy};
    };
    const auto is_inside = [](const Corner& p, const Line& l) {
        const auto [low, high] = std::minmax(l[0][0], l[1][0]);
        return low < p[0] && p[0] < high;
    };
    const auto area = [](const std::array<Corner, 3>& p) {
        return (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
               (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    };
    for (;;) {
        std::array<Line, 3> lines;
        for (Line& l : lines) l = {{{at(), at()}, {at(), at()}}};
        std::array<Corner, 3> p, rounded_to;
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const Line &l = lines[k], &m = lines[(k + 1) % 3];
            p[k] = crossing(l, m);
            inside = inside && is_inside(p[k], l) && is_inside(p[k], m);
            for (std::size_t i = 0; i < 2; ++i)
                rounded_to[k][i] = spacing_of_doubles * std::round(p[k][i] / spacing_of_doubles);
        }
        if (inside && std::fabs(area(p)) > 1e-9 && area(p) * area(rounded_to) < 0) return lines;
    }
}

/// One plane, in which enough triangles overlap for the arrangement to pool them, and no other
/// surface. All triangles lie in the first one. Where the sides of three of them cross, a part turns
/// over when it is rounded.
std::vector<Surface> lone_pool(std::mt19937& random) {
    constexpr double corner = 0x1p46, corner_spacing = 0x1p-6;
    Surface s;
    const unsigned plane = random() % 3;
    const auto add = [&](const std::array<std::array<double, 2>, 3>& corners) {
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        for (const auto& c : corners) {
            const double x = corner + c[0], y = corner + c[1];
            s.vertices.push_back({x, y, plane == 0 ? 0 : plane == 1 ? x : y});
        }
        s.triangles.push_back({first, first + 1, first + 2});
    };
    const auto far = [&] { return 1000.0 + random() % 900; };
    add({{{0, 0}, {4000, 0}, {0, 4000}}});
    for (int k = 1; k < 60; ++k) add({{{0, 0}, {1.0 * k, 0}, {0, 1.0 * k}}});
    for (const Line& l : nearly_concurrent(random, corner_spacing))
        add({l[0], l[1], {far(), far()}});
    return {s};
}

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

Pairs pairs_of(const RoundingReport& report) {
    Pairs pairs;
    for (const ImproperContact& c : report.contacts) pairs.push_back(c.triangles);
    return pairs;
}

void same_verdict(const Arrangement& a, unsigned max_rounds) {
    RoundingOptions quick = counting, slow = full;
    quick.max_rounds = slow.max_rounds = max_rounds;
    const auto r = rounded(a, quick), s = rounded(a, slow);
    REQUIRE(r.report.clean == s.report.clean);
    CHECK(pairs_of(r.report) == pairs_of(s.report));
    CHECK(r.mesh->vertices == s.mesh->vertices);
    CHECK(r.mesh->triangles == s.mesh->triangles);
    REQUIRE(r.report.pairs);
    REQUIRE(s.report.pairs);
    check_laws(r.mesh, *r.report.pairs);
    check_laws(s.mesh, *s.report.pairs);
    CHECK(s.report.pairs->in_patches + s.report.pairs->separated + s.report.pairs->unmoved ==
          0); // law (3)
    CHECK(r.report.pairs->tested <= s.report.pairs->tested);
    if (r.report.clean) CHECK(r.conforming->pairs() == r.report.pairs);
}

} // namespace

TEST_CASE("pair check: a full check gives the same mesh and verdict as proven bounds") {
    same_verdict(arranged(crossed_sheets(12)), 8);
    for (const unsigned rounds : {0U, 8U})
        for (const unsigned n : {3U, 8U, 16U}) same_verdict(arranged(nearly_coplanar(n)), rounds);
    std::mt19937 random(7);
    for (int k = 0; k < 20; ++k) same_verdict(arranged(random_soup(random)), k % 2 == 0 ? 8 : 0);
}

TEST_CASE("pair check: the same where triangles are pooled, or share a vertex with very many") {
    std::mt19937 random(9);
    const auto pooled = arranged(pooled_soup(random));
    REQUIRE(!pooled.state->pools.empty());
    same_verdict(pooled, 0);
    std::size_t contacts = 0;
    for (int k = 0; k <= cases(3) || (contacts == 0 && k <= 3); ++k) {
        const bool overlapping = k > 0;
        const auto a = arranged(crowded_soup(random, overlapping));
        CHECK(a.state->crowded.empty() == overlapping); // few pairs for so large a mesh
        const std::size_t n = a.state->corners.size();
        if (overlapping) // all pairs but those of two triangles that nothing crosses
            CHECK(a.state->neighbours.size() > n * (n - 1) / 2 - n);
        same_verdict(a, 0);
        if (overlapping) contacts += rounded(a, {.max_rounds = 0}).report.contacts.size();
    }
    CHECK(contacts > 0);
    // Of a pool, separation says nothing: all contacts are found by the search within it.
    contacts = 0;
    for (int k = 0; k < 60; ++k) {
        auto a = arranged(nearly_coplanar_soup(random));
        const auto sound = rounded(a, {0, full.check});
        ExactState& state = own_state(a);
        state.pools.assign(state.corners.size(), 0);
        state.neighbours.clear();
        CHECK(pairs_of(rounded(a, {.max_rounds = 0}).report) == pairs_of(sound.report));
        contacts += sound.report.contacts.size();
    }
    CHECK(contacts > 0);
}

TEST_CASE("pair check: the same where all triangles are in one pool, and turn over in it") {
    std::mt19937 random(10);
    int turned_over = 0;
    const int count = cases(20) + 3;
    for (int k = 0; k < count; ++k) {
        const auto a = arranged(lone_pool(random));
        REQUIRE(!a.state->pools.empty());
        CHECK(a.state->neighbours.empty()); // only the search within the pool can find them
        same_verdict(a, 0);
        const auto unrepaired = rounded(a, {.max_rounds = 0});
        const Mesh &first = unrepaired.mesh, last = rounded(a).mesh;
        turned_over += !unrepaired.report.clean;
        REQUIRE(unrepaired.report.clean ==
                verify_conforming(first.vertices, first.triangles).empty());
        CHECK(verify_conforming(last.vertices, last.triangles).empty());
    }
    CHECK(2 * turned_over > count);
}

TEST_CASE(
    "pair check: in a pool, what no face has in common, or is ill conditioned, needs a test") {
    using rounding::detail::Pools;
    IndexLists<std::uint32_t> parents;
    for (const std::vector<std::uint32_t>& list :
         {std::vector{0U}, {0U, 1U}, {1U}, {2U}, {3U}, {0U, 1U}}) // face 3 is in no pool
        parents.push_back(list);
    const Pools pools{
        {0, 0, 0, 1, no_group, 0}, {}, {true, true, false, true, true, false}, &parents};
    CHECK(pools.need_test({0, 1}));       // both are ill conditioned
    CHECK_FALSE(pools.need_test({1, 2})); // parts of face 1, one of them well conditioned
    CHECK_FALSE(pools.need_test({0, 5}));
    CHECK(pools.need_test({0, 2}));       // parts of no common face
    CHECK_FALSE(pools.need_test({0, 3})); // of two pools
    CHECK_FALSE(pools.need_test({0, 4}));
    CHECK_FALSE(pools.need_test({4, 4}));
    CHECK_FALSE(Pools{}.need_test({0, 1}));
}

TEST_CASE("pair check: bounds clear most pairs of crossing sheets, in each of the ways") {
    const auto a = arranged(crossed_sheets(24));
    const auto r = rounded(a, counting);
    REQUIRE(r.report.clean);
    const PairCounts& counts = *r.report.pairs;
    check_laws(r.mesh, counts);
    CHECK(counts.in_patches > 0);
    CHECK(counts.separated > 0);
    CHECK(counts.unmoved > 0);
    CHECK(counts.tested < not_apart(counts) / 10);
    CHECK_FALSE(rounded(a).report.pairs); // not asked for
}

TEST_CASE("pair check: a full check finds what a broken shortcut hides") {
    constexpr RoundingOptions no_rounds{.max_rounds = 0}, full_no_rounds{0, full.check};
    std::mt19937 random(8);
    int hidden = 0;
    for (int k = 0; k < 60; ++k) {
        auto a = arranged(nearly_coplanar_soup(random));
        const auto sound = rounded(a, full_no_rounds);
        CHECK(pairs_of(rounded(a, no_rounds).report) == pairs_of(sound.report));
        own_state(a).neighbours.clear(); // planted: separation is told of no pair of faces
        hidden += rounded(a, no_rounds).report.contacts.size() < sound.report.contacts.size();
        CHECK(pairs_of(rounded(a, full_no_rounds).report) == pairs_of(sound.report));
    }
    CHECK(hidden > 0);
}

TEST_CASE("pair check: meshes are proven conforming, or not, by either method") {
    const auto proven = rounded(arranged(crossed_sheets(12)));
    REQUIRE(proven.report.clean);
    Mesh mesh = proven.mesh;
    std::vector<std::uint32_t> labels;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        labels.push_back(mesh.surfaces_of[t][0]);
    for (const PairCheck method : {PairCheck::bounds, PairCheck::full}) {
        const auto proof = prove_conforming(mesh, labels, {method, SIZE_MAX});
        REQUIRE(proof);
        REQUIRE(proof->pairs());
        check_laws(mesh, *proof->pairs());
        CHECK((proof->pairs()->in_patches == 0) == (method == PairCheck::full)); // law (3)
        CHECK_FALSE(prove_conforming(mesh, labels)->pairs());
    }
    // A vertex in the middle of the sheet falls through the planes across it.
    const auto moved =
        std::find_if(mesh.vertices.begin(), mesh.vertices.end(), [](const Point3& p) {
            return std::fabs(p.x - 0.45) < 0.05 && std::fabs(p.y - 0.5) < 0.05 &&
                   std::fabs(p.z) < 0.2;
        });
    REQUIRE(moved != mesh.vertices.end());
    moved->x += 0.4;
    for (const PairCheck method : {PairCheck::bounds, PairCheck::full}) {
        const auto refused = prove_conforming(mesh, labels, {method, SIZE_MAX});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::improper_contact);
    }
}
