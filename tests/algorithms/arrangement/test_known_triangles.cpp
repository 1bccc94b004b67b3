// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrangements of surfaces of which most are those of the arrangement before.
#include "support/differences.hpp"
#include "support/effort.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/known_triangles.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace terrane;
using namespace test_support;

using Engine = std::mt19937;

double uniform(Engine& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
}

int below(Engine& random, int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
}

/// A sheet of n x n cells across the unit cube, inclined at random and uneven.
Surface random_sheet(Engine& random, int n) {
    const double height = uniform(random, 0.2, 0.8), slope = uniform(random, -0.4, 0.4);
    Surface s{"sheet " + std::to_string(random()), Role::unknown, {}, {}};
    const int across = below(random, 3);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
            const double w = height + slope * u + uniform(random, -0.02, 0.02);
            s.vertices.push_back(across == 0   ? Point3{w, u, v}
                                 : across == 1 ? Point3{v, w, u}
                                               : Point3{u, v, w});
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (n + 1) + i);
            const auto b = a + static_cast<std::uint32_t>(n) + 1;
            s.triangles.push_back({a, a + 1, b + 1});
            s.triangles.push_back({a, b + 1, b});
        }
    return s;
}

/// Triangles with corners on a lattice: many touch, overlap, or have no area.
Surface lattice_soup(Engine& random, int triangles) {
    Surface s{"soup", Role::unknown, {}, {}};
    for (int t = 0; t < triangles; ++t) {
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        for (int k = 0; k < 3; ++k)
            s.vertices.push_back(
                {below(random, 4) / 3.0, below(random, 4) / 3.0, below(random, 4) / 3.0});
        s.triangles.push_back({first, first + 1, first + 2});
    }
    return s;
}

/// Tetrahedra, some of which overlap: no projection is injective on one of them, but some are on parts of
/// it.
Surface tetrahedra(Engine& random, int count) {
    Surface s{"tetrahedra", Role::unknown, {}, {}};
    for (int k = 0; k < count; ++k) {
        const auto a = static_cast<std::uint32_t>(s.vertices.size());
        for (int corner = 0; corner < 4; ++corner)
            s.vertices.push_back(
                {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)});
        for (const Triangle& t :
             {Triangle{0, 1, 2}, Triangle{0, 3, 1}, Triangle{1, 3, 2}, Triangle{0, 2, 3}})
            s.triangles.push_back({a + t[0], a + t[1], a + t[2]});
    }
    return s;
}

Point3 moved(const Point3& p, double dz) {
    return {p.x, p.y, p.z + dz};
}

/// Changes a model as users and the closing of gaps do.
void change(Engine& random, std::vector<Surface>& model) {
    Surface& s = model[static_cast<std::size_t>(below(random, static_cast<int>(model.size())))];
    switch (below(random, 9)) {
    case 0: // nothing
        return;
    case 1: // a whole surface
        for (Point3& p : s.vertices) p = moved(p, 0.01);
        return;
    case 2: { // a vertex
        Point3& p = s.vertices[random() % s.vertices.size()];
        p = moved(p, uniform(random, -0.02, 0.02));
        return;
    }
    case 3: { // a strip
        const auto [a, b, c] = s.triangles[random() % s.triangles.size()];
        s.vertices.push_back(moved(s.vertices[c], 0.05));
        s.triangles.push_back({a, b, static_cast<std::uint32_t>(s.vertices.size() - 1)});
        return;
    }
    case 4: // a hole
        s.triangles.erase(s.triangles.begin() +
                          static_cast<std::ptrdiff_t>(random() % s.triangles.size()));
        return;
    case 5: // another order
        std::shuffle(model.begin(), model.end(), random);
        return;
    case 6: // the same triangles in another order, some of them turned
        std::shuffle(s.triangles.begin(), s.triangles.end(), random);
        for (Triangle& t : s.triangles)
            if (below(random, 8) == 0) std::rotate(t.begin(), t.begin() + 1, t.end());
        return;
    case 7: // a repeated triangle in another surface
        if (model.size() > 1) {
            Surface& other = &s == &model.front() ? model.back() : model.front();
            const Triangle t = s.triangles[random() % s.triangles.size()];
            const auto first = static_cast<std::uint32_t>(other.vertices.size());
            for (const std::uint32_t v : t) other.vertices.push_back(s.vertices[v]);
            other.triangles.push_back({first, first + 1, first + 2});
        }
        return;
    default: // a new surface in place of another
        s = random_sheet(random, 3 + below(random, 6));
    }
}

void require_same(const Arrangement& a, const Arrangement& b) {
    REQUIRE(difference(a, b) == "");
}

Arrangement arranged_with(KnownTriangles& known, const std::vector<Surface>& model,
                          const Run& run = {}) {
    auto a = arrange(model, {}, known, run);
    REQUIRE(a);
    return std::move(a).value();
}

Arrangement arranged_anew(const std::vector<Surface>& model) {
    auto a = arrange(model);
    REQUIRE(a);
    return std::move(a).value();
}

/// Arranges a model, and again after each of several changes.
std::size_t check_changes(Engine& random, std::vector<Surface> model, int changes) {
    KnownTriangles known;
    std::size_t taken_over = 0;
    for (int k = 0; k <= changes; ++k) {
        const Arrangement again = arranged_with(known, model);
        require_same(again, arranged_anew(model));
        taken_over += again.statistics.known;
        change(random, model);
    }
    return taken_over;
}

} // namespace

TEST_CASE("known triangles: an arrangement after changes is the same as anew", "[arrangement]") {
    Engine random(91);
    std::size_t taken_over = 0;
    for (int k = 0; k < cases(60); ++k) {
        std::vector<Surface> model;
        const int count = 2 + below(random, 4);
        for (int s = 0; s < count; ++s) model.push_back(random_sheet(random, 3 + below(random, 8)));
        if (k % 3 == 0) model.push_back(lattice_soup(random, 40));
        if (k % 2 == 0) model.insert(model.begin(), tetrahedra(random, 1 + below(random, 4)));
        taken_over += check_changes(random, std::move(model), 8);
    }
    CHECK(taken_over > 0);
}

TEST_CASE("known triangles: soups on a lattice", "[arrangement]") {
    Engine random(92);
    for (int k = 0; k < cases(8); ++k)
        check_changes(random, {lattice_soup(random, 60), lattice_soup(random, 30)}, 5);
}

TEST_CASE("known triangles: what stays is not tested again", "[arrangement]") {
    Engine random(93);
    std::vector<Surface> model{random_sheet(random, 20), random_sheet(random, 20),
                               random_sheet(random, 20)};
    KnownTriangles known;
    const Arrangement first = arranged_with(known, model);
    CHECK(first.statistics.known == 0);
    const Arrangement same = arranged_with(known, model);
    CHECK(same.statistics.known == first.statistics.candidates); // those in contact, too
    CHECK(same.statistics.candidates == first.statistics.candidates);
    CHECK(same.statistics.improper_contacts > 0);
    for (Point3& p : model[1].vertices) p = moved(p, 0.01);
    const Arrangement after = arranged_with(known, model);
    CHECK(after.statistics.known < same.statistics.known);
    for (Surface& s : model)
        for (Point3& p : s.vertices) p = moved(p, 0.001);
    CHECK(arranged_with(known, model).statistics.known == 0);
}

TEST_CASE("known triangles: patches of surfaces that stay are taken over", "[arrangement]") {
    Engine random(97);
    std::vector<Surface> model{random_sheet(random, 9), tetrahedra(random, 3),
                               random_sheet(random, 9)};
    const auto patches_in = [](const Soup& soup) {
        return find_injective_patches(soup.points, soup.triangles, soup.surface_of, soup.edges);
    };
    KnownTriangles known;
    const Soup before = merge_surfaces(model);
    const InjectivePatches found = patches_in(before);
    REQUIRE(found.axis.size() > 4);
    InjectivePatches marked = found; // as no proof finds them
    for (Axis& axis : marked.axis) axis = axis == Axis::x ? Axis::y : Axis::x;
    const auto axis_at = [](const InjectivePatches& patches, const Soup& soup, std::uint32_t s) {
        const auto first = std::ranges::find(soup.surface_of, s) - soup.surface_of.begin();
        return patches.axis.at(patches.of.at(static_cast<std::size_t>(first)));
    };
    const auto keep = [&] { known.keep(before.points, before, marked, {}); };

    SECTION("one moved") {
        for (Point3& p : model[0].vertices) p = moved(p, 0.01);
        keep();
        const Soup after = merge_surfaces(model);
        const auto patches = known.find_in(after)->patches();
        CHECK(patches.of == patches_in(after).of);
        CHECK(axis_at(patches, after, 0) == axis_at(found, before, 0));
        CHECK(axis_at(patches, after, 1) == axis_at(marked, before, 1));
        CHECK(axis_at(patches, after, 2) == axis_at(marked, before, 2));
        CHECK(known.find_in(after) == nullptr);
    }
    SECTION("another order") {
        std::swap(model[0], model[1]);
        keep();
        const Soup after = merge_surfaces(model);
        const auto patches = known.find_in(after)->patches();
        CHECK(patches.of == patches_in(after).of);
        CHECK(axis_at(patches, after, 0) == axis_at(marked, before, 1));
        CHECK(axis_at(patches, after, 1) == axis_at(marked, before, 0));
    }
    SECTION("a triangle less, and one turned") {
        model[0].triangles.pop_back();
        auto& turned = model[2].triangles.front();
        std::swap(turned[0], turned[1]);
        keep();
        const Soup after = merge_surfaces(model);
        const auto patches = known.find_in(after)->patches();
        CHECK(patches.axis.size() == found.axis.size());
        CHECK(axis_at(patches, after, 0) == axis_at(found, before, 0));
        CHECK(axis_at(patches, after, 1) == axis_at(marked, before, 1));
        CHECK(axis_at(patches, after, 2) == axis_at(found, before, 2));
        CHECK(patches.turn == patches_in(after).turn);
    }
    SECTION("the last triangle of a surface becomes the first one of the next") {
        const Triangle last = model[0].triangles.back();
        model[0].triangles.pop_back();
        const auto first = static_cast<std::uint32_t>(model[1].vertices.size());
        for (const std::uint32_t v : last) model[1].vertices.push_back(model[0].vertices[v]);
        model[1].triangles.insert(model[1].triangles.begin(), {first, first + 1, first + 2});
        keep();
        const Soup after = merge_surfaces(model);
        const auto patches = known.find_in(after)->patches();
        CHECK(patches.of == patches_in(after).of);
        CHECK(axis_at(patches, after, 0) == axis_at(found, before, 0));
        CHECK(axis_at(patches, after, 1) == axis_at(patches_in(after), after, 1));
        CHECK(axis_at(patches, after, 2) == axis_at(marked, before, 2));
    }
    SECTION("two surfaces become one") {
        const auto first = static_cast<std::uint32_t>(model[0].vertices.size());
        for (const Point3& p : model[1].vertices) model[0].vertices.push_back(p);
        for (const Triangle& t : model[1].triangles)
            model[0].triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        model.erase(model.begin() + 1);
        keep();
        const Soup after = merge_surfaces(model);
        const auto patches = known.find_in(after)->patches();
        CHECK(patches.of == patches_in(after).of);
        CHECK(axis_at(patches, after, 0) == axis_at(patches_in(after), after, 0));
        CHECK(axis_at(patches, after, 1) == axis_at(marked, before, 2));
    }
}

TEST_CASE("known triangles: edges of triangles that stay are taken over", "[arrangement]") {
    Engine random(99);
    std::vector<Surface> model{random_sheet(random, 9), random_sheet(random, 9)};
    Soup before = merge_surfaces(model);
    const EdgeSides right = before.edges;
    before.edges.sides.clear(); // so that it shows where they are from
    std::ranges::fill(before.edges.starts, 0U);
    KnownTriangles known;
    known.keep(before.points, before, {std::vector(before.triangles.size(), no_group), {}, {}}, {});
    for (Point3& p : model[1].vertices) p = moved(p, 0.01);
    const Soup after = merge_surfaces(model);
    CHECK(std::ranges::equal(after.edges.sides, right.sides));
    const EdgeSides found = known.find_in(after)->edges();
    const std::uint32_t first = after.first_input_vertex[1];
    CHECK(found.starts[first] == 0);
    CHECK(found.sides.size() == right.sides.size() - right.starts[first]);
}

TEST_CASE("known triangles: a contact gets the vertices' new numbers", "[arrangement]") {
    Engine random(100);
    const auto tested_again = [&](const std::vector<Surface>& before,
                                  const std::vector<Surface>& after) {
        KnownTriangles known;
        const Arrangement first = arranged_with(known, before);
        REQUIRE(first.statistics.improper_contacts > 0);
        const Arrangement again = arranged_with(known, after);
        require_same(again, arranged_anew(after));
        return again.statistics.candidates - again.statistics.known;
    };
    const Surface one = random_sheet(random, 9), two = random_sheet(random, 9);
    Surface far = random_sheet(random, 12);
    for (Point3& p : far.vertices) p = moved(p, 9);
    CHECK(tested_again({one, two}, {far, one, far, two}) == 0);
    CHECK(tested_again({far, one, far, two}, {one, two}) == 0);
    // Edges of coplanar triangles cross.
    const auto level = [](double shift) {
        return Surface{"level",
                       Role::unknown,
                       {{shift, shift, 0.5}, {shift + 1, shift, 0.5}, {shift, shift + 1, 0.5}},
                       {{0, 1, 2}}};
    };
    CHECK(tested_again({level(0), level(0.3), far}, {far, level(0), level(0.3)}) == 0);
    // The first triangle of a pair becomes the second one, over the same vertices.
    Surface crossed{
        "crossed",
        Role::unknown,
        {{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}, {0.2, 0.2, 0}, {0.2, 0.2, 1}, {1, 1, 1}},
        {{0, 1, 2}, {3, 4, 5}}};
    Surface exchanged = crossed;
    std::swap(exchanged.triangles[0], exchanged.triangles[1]);
    CHECK(tested_again({crossed, far}, {exchanged, far}) == 1);
    // In another order the pairs are tested again, as are those whose corners are in another order.
    CHECK(tested_again({one, two}, {two, one}) > 0);
    Surface reversed = one;
    std::ranges::reverse(reversed.vertices);
    for (Triangle& t : reversed.triangles)
        for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(one.vertices.size()) - 1 - v;
    CHECK(tested_again({one, two}, {reversed, two}) > 0);
}

TEST_CASE("known triangles: where triangles meet densely, pairs are left out",
          "[arrangement][once]") {
    Engine random(94);
    Surface dense{"dense", Role::unknown, {}, {}};
    const auto add = [&](const Point3& a, const Point3& b, const Point3& c) {
        const auto first = static_cast<std::uint32_t>(dense.vertices.size());
        for (const Point3& p : {a, b, c}) dense.vertices.push_back(p);
        dense.triangles.push_back({first, first + 1, first + 2});
    };
    SECTION("at a vertex of very many triangles") {
        for (int k = 0; k < 2000; ++k) {
            const auto at = [&](double share) {
                const double angle = 6.283 * (k + share) / 2000;
                return Point3{0.5 + std::cos(angle), 0.5 + std::sin(angle), 0.4 + 0.2 * share};
            };
            add({0.5, 0.5, 0.5}, at(0), at(0.8));
        }
    }
    SECTION("in planes through one line") {
        for (int k = 0; k < 600; ++k)
            add({uniform(random, -0.5, 1.5), uniform(random, -0.5, 1.5), uniform(random, 0, 1)},
                {0.5, 0.5, -1 - uniform(random, 0, 1)}, {0.5, 0.5, 2 + uniform(random, 0, 1)});
    }
    SECTION("in one plane") {
        for (int k = 0; k < 150; ++k) {
            const auto at = [&] {
                return Point3{uniform(random, 0, 1), uniform(random, 0, 1), 0.5};
            };
            add(at(), at(), at());
        }
    }
    const Surface sheet = random_sheet(random, 40);
    Surface few = dense;
    few.triangles.resize(12);
    for (const auto& [first, second] : {std::pair{dense, few}, std::pair{few, dense}}) {
        KnownTriangles known;
        arranged_with(known, {sheet, first});
        require_same(arranged_with(known, {sheet, second}), arranged_anew({sheet, second}));
    }
    check_changes(random, {sheet, dense}, 2);
}

TEST_CASE("known triangles: a pair that was near comes into a pool", "[arrangement]") {
    Engine random(98);
    const auto triangle = [](const Point3& a, const Point3& b, const Point3& c) {
        return Surface{"triangle", Role::unknown, {a, b, c}, {{0, 1, 2}}};
    };
    std::vector<Surface> model{random_sheet(random, 40),
                               triangle({0.5, 0.5, 0.5}, {0.9, 0.5, 0.5}, {0.5, 0.9, 0.5}),
                               triangle({0.5, 0.5, 0.5}, {0.1, 0.5, 0.5}, {0.5, 0.1, 0.5})};
    KnownTriangles known;
    const Arrangement first = arranged_with(known, model);
    CHECK(first.state->pools.empty());
    for (int k = 0; k < 150; ++k) {
        const auto at = [&] { return Point3{uniform(random, 0, 1), uniform(random, 0, 1), 0.5}; };
        model.push_back(triangle(at(), at(), at()));
    }
    const Arrangement again = arranged_with(known, model);
    CHECK(again.statistics.known > 0);
    CHECK(again.state->pools[model.front().triangles.size()] != no_group);
    require_same(again, arranged_anew(model));
}

TEST_CASE("known triangles: several threads may use one object", "[arrangement][threads]") {
    Engine random(95);
    const std::vector<Surface> model{random_sheet(random, 9), random_sheet(random, 9)};
    const Arrangement anew = arranged_anew(model);
    KnownTriangles known;
    std::vector<std::vector<Triangle>> found(4);
    std::vector<std::thread> threads;
    for (auto& triangles : found)
        threads.emplace_back([&] {
            for (int k = 0; k < 5; ++k) {
                const auto a = arrange(model, {}, known, Run{.threads = 1});
                triangles = a ? a.value().triangles : std::vector<Triangle>{};
                if (triangles != anew.triangles) return;
            }
        });
    for (std::thread& t : threads) t.join();
    for (const auto& triangles : found) CHECK(triangles == anew.triangles);
}

TEST_CASE("known triangles: a stopped arrangement keeps nothing", "[arrangement]") {
    Engine random(96);
    const std::vector<Surface> model{random_sheet(random, 9), random_sheet(random, 9)};
    KnownTriangles known;
    arranged_with(known, model);
    std::stop_source stop;
    stop.request_stop();
    Run run;
    run.stop = stop.get_token();
    CHECK(arrange(model, {}, known, run).error().code == ErrorCode::interrupted);
    require_same(arranged_with(known, model), arranged_anew(model));
}
