// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Edges and adjacency of meshes that share triangles with an older one.
#include "support/effort.hpp"

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/edges.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace terrane;
using namespace test_support;

namespace {

using Engine = std::mt19937;

std::uint32_t below(Engine& random, std::size_t n) {
    return static_cast<std::uint32_t>(random() % n);
}

Triangle random_triangle(Engine& random, std::size_t vertices) {
    Triangle t{};
    do {
        for (std::uint32_t& v : t) v = below(random, vertices);
    } while (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]);
    return t;
}

/// Triangles no two of which have the same three corners.
std::vector<Triangle> random_triangles(Engine& random, std::size_t count, std::size_t vertices) {
    std::vector<Triangle> triangles;
    std::set<Triangle> seen;
    for (std::size_t k = 0; k < count; ++k) {
        const Triangle t = random_triangle(random, vertices);
        Triangle sorted = t;
        std::ranges::sort(sorted);
        if (seen.insert(sorted).second) triangles.push_back(t);
    }
    return triangles;
}

/// New numbers for vertices: all moved up, and every so often two exchanged.
std::vector<std::uint32_t> new_names(Engine& random, std::size_t vertices, bool any_order) {
    std::vector<std::uint32_t> names(vertices);
    std::uint32_t next = below(random, 3);
    for (std::uint32_t& name : names) name = std::exchange(next, next + 1 + below(random, 2));
    for (std::size_t k = 1; any_order && k < vertices; ++k)
        if (below(random, 4) == 0) std::swap(names[k], names[below(random, k)]);
    return names;
}

void check_same(const EdgeSides& a, const EdgeSides& b) {
    REQUIRE(a.starts == b.starts);
    REQUIRE(std::ranges::equal(a.sides, b.sides));
}

/// Drops, renames, repeats, adds and shuffles triangles, and compares their edges with those grouped
/// anew. Returns how many triangles were taken over.
std::size_t check_change(Engine& random, const Run& run) {
    const std::size_t vertices = 4 + below(random, 40), count = 1 + below(random, 60);
    const auto old = random_triangles(random, count, vertices);
    const auto names = new_names(random, vertices, below(random, 2) == 0);
    const std::uint32_t vertex_count = *std::ranges::max_element(names) + 4;
    std::vector<std::uint32_t> order(old.size());
    std::iota(order.begin(), order.end(), 0U);
    if (below(random, 2) == 0) std::ranges::shuffle(order, random);
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> old_of;
    for (const std::uint32_t t : order) {
        if (below(random, 6) == 0) continue;
        const std::uint32_t times = below(random, 20) == 0 ? 2 : 1; // a repeated one
        for (std::uint32_t k = 0; k < times; ++k) {
            triangles.push_back({names[old[t][0]], names[old[t][1]], names[old[t][2]]});
            old_of.push_back(t);
        }
        if (below(random, 6) != 0) continue;
        triangles.push_back(random_triangle(random, vertex_count));
        old_of.push_back(no_index);
    }
    const RenamedTriangles renamed(old, vertices, triangles, old_of);
    check_same(edges_after(group_edges(old, vertices), renamed, triangles, vertex_count, run),
               group_edges(triangles, vertex_count));
    return triangles.size() - renamed.others.size();
}

} // namespace

TEST_CASE("edges_after: the edges are those of grouping anew", "[mesh]") {
    Engine random(71);
    std::size_t taken_over = 0;
    for (int k = 0; k < cases(2000); ++k) taken_over += check_change(random, {});
    CHECK(taken_over > 0);
}

TEST_CASE("edges_after: in threads", "[mesh][threads]") {
    Engine random(72);
    const auto old = random_triangles(random, 60'000, 20'000);
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> old_of;
    for (std::uint32_t t = 0; t < old.size(); ++t) {
        if (t % 97 == 0) {
            triangles.push_back(random_triangle(random, 20'002));
            old_of.push_back(no_index);
        }
        if (t % 89 == 0) continue;
        triangles.push_back({old[t][0] + 2, old[t][1] + 2, old[t][2] + 2});
        old_of.push_back(t);
    }
    const RenamedTriangles renamed(old, 20'000, triangles, old_of);
    CHECK(renamed.others.size() < 700);
    check_same(edges_after(group_edges(old, 20'000), renamed, triangles, 20'002, {.threads = 4}),
               group_edges(triangles, 20'002));
}

TEST_CASE("adjacency_of_kept: it is that of the kept triangles", "[mesh]") {
    Engine random(73);
    std::size_t inner_edges = 0;
    const auto all_inner = [](const Adjacency& a) {
        std::vector<std::array<std::uint32_t, 2>> all;
        for (const auto& list : a.inner)
            for (const auto& [t, u] : list) all.push_back({std::min(t, u), std::max(t, u)});
        std::ranges::sort(all);
        return all;
    };
    for (int k = 0; k < cases(2000); ++k) {
        const std::size_t vertices = 4 + below(random, 20);
        const auto triangles = random_triangles(random, 1 + below(random, 60), vertices);
        Labels labels;
        std::vector<bool> keep;
        std::vector<Triangle> kept;
        Labels kept_labels;
        const std::uint32_t rare = 1 + below(random, 6);
        for (const Triangle& t : triangles) {
            const std::uint32_t label = below(random, 3);
            labels.push_back(label == 2 ? no_label : label);
            keep.push_back(below(random, rare + 1) != 0);
            if (!keep.back()) continue;
            kept.push_back(t);
            kept_labels.push_back(labels.back());
        }
        Adjacency all = adjacency_of(group_edges(triangles, vertices), labels);
        std::ranges::shuffle(all.inner.front(), random); // they may be in any order, and split
        auto& second = all.inner.emplace_back();
        for (; second.size() < all.inner.front().size(); all.inner.front().pop_back())
            second.push_back(all.inner.front().back());
        const Adjacency found = adjacency_of_kept(all, labels, triangles, keep);
        const Adjacency right = adjacency_of(group_edges(kept, vertices), kept_labels);
        REQUIRE(found.edges == right.edges);
        REQUIRE(found.triangles_at == right.triangles_at);
        REQUIRE(all_inner(found) == all_inner(right));
        inner_edges += all_inner(found).size();
    }
    CHECK(inner_edges > 0);
}
