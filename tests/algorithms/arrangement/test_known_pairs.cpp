// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrangements of surfaces of which most are those of the arrangement before.
#include "support/effort.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/known_pairs.hpp>
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
    REQUIRE(a.vertices == b.vertices);
    REQUIRE(a.triangles == b.triangles);
    REQUIRE(a.parents_of == b.parents_of);
    REQUIRE(a.surfaces_of == b.surfaces_of);
    REQUIRE(a.intersection_edges == b.intersection_edges);
    REQUIRE(a.statistics.candidates == b.statistics.candidates);
    REQUIRE(a.statistics.improper_contacts == b.statistics.improper_contacts);
    REQUIRE(a.state->neighbours == b.state->neighbours);
    REQUIRE(a.state->crowded == b.state->crowded);
    REQUIRE(a.state->pools == b.state->pools);
    REQUIRE(a.state->patches.of == b.state->patches.of);
    for (std::uint32_t v = 0; v < a.vertices.size(); ++v) {
        REQUIRE(a.construction(VertexId(v)) == b.construction(VertexId(v)));
        REQUIRE(a.nearest(VertexId(v)) == b.nearest(VertexId(v)));
    }
}

Arrangement arranged_with(KnownPairs& known, const std::vector<Surface>& model,
                          const Run& run = {}) {
    auto a = arrange(model, {.known = &known}, run);
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
    KnownPairs known;
    std::size_t taken_over = 0;
    for (int k = 0; k <= changes; ++k) {
        const Arrangement again = arranged_with(known, model);
        require_same(again, arranged_anew(model));
        taken_over += again.statistics.known_apart;
        change(random, model);
    }
    return taken_over;
}

} // namespace

TEST_CASE("known pairs: an arrangement after changes is the same as anew", "[arrangement]") {
    Engine random(91);
    std::size_t taken_over = 0;
    for (int k = 0; k < cases(60); ++k) {
        std::vector<Surface> model;
        const int count = 2 + below(random, 4);
        for (int s = 0; s < count; ++s) model.push_back(random_sheet(random, 3 + below(random, 8)));
        if (k % 3 == 0) model.push_back(lattice_soup(random, 40));
        taken_over += check_changes(random, std::move(model), 8);
    }
    CHECK(taken_over > 0);
}

TEST_CASE("known pairs: soups on a lattice", "[arrangement]") {
    Engine random(92);
    for (int k = 0; k < cases(8); ++k)
        check_changes(random, {lattice_soup(random, 60), lattice_soup(random, 30)}, 5);
}

TEST_CASE("known pairs: what stays is not tested again", "[arrangement]") {
    Engine random(93);
    std::vector<Surface> model{random_sheet(random, 20), random_sheet(random, 20),
                               random_sheet(random, 20)};
    KnownPairs known;
    const Arrangement first = arranged_with(known, model);
    CHECK(first.statistics.known_apart == 0);
    const Arrangement same = arranged_with(known, model);
    CHECK(same.statistics.known_apart > 0);
    CHECK(same.statistics.candidates == first.statistics.candidates);
    for (Point3& p : model[1].vertices) p = moved(p, 0.01);
    const Arrangement after = arranged_with(known, model);
    CHECK(after.statistics.known_apart < same.statistics.known_apart);
    for (Surface& s : model)
        for (Point3& p : s.vertices) p = moved(p, 0.001);
    CHECK(arranged_with(known, model).statistics.known_apart == 0);
}

TEST_CASE("known pairs: where triangles meet densely, pairs are left out", "[arrangement]") {
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
        KnownPairs known;
        arranged_with(known, {sheet, first});
        require_same(arranged_with(known, {sheet, second}), arranged_anew({sheet, second}));
    }
    check_changes(random, {sheet, dense}, 2);
}

TEST_CASE("known pairs: several threads may use one object", "[arrangement][threads]") {
    Engine random(95);
    const std::vector<Surface> model{random_sheet(random, 9), random_sheet(random, 9)};
    const Arrangement anew = arranged_anew(model);
    KnownPairs known;
    std::vector<std::vector<Triangle>> found(4);
    std::vector<std::thread> threads;
    for (auto& triangles : found)
        threads.emplace_back([&] {
            for (int k = 0; k < 5; ++k) {
                const auto a = arrange(model, {.known = &known}, Run{.threads = 1});
                triangles = a ? a.value().triangles : std::vector<Triangle>{};
                if (triangles != anew.triangles) return;
            }
        });
    for (std::thread& t : threads) t.join();
    for (const auto& triangles : found) CHECK(triangles == anew.triangles);
}

TEST_CASE("known pairs: a stopped arrangement keeps nothing", "[arrangement]") {
    Engine random(96);
    const std::vector<Surface> model{random_sheet(random, 9), random_sheet(random, 9)};
    KnownPairs known;
    arranged_with(known, model);
    std::stop_source stop;
    stop.request_stop();
    Run run;
    run.stop = stop.get_token();
    CHECK(arrange(model, {.known = &known}, run).error().code == ErrorCode::interrupted);
    require_same(arranged_with(known, model), arranged_anew(model));
}
