// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the tree with a look at every triangle, and counts what it looks at.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/surface_tree.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>

using namespace terrane;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void add_triangle(Mesh& mesh, const std::array<Point3, 3>& corners,
                  const std::vector<std::uint32_t>& surfaces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.surfaces_of.push_back(surfaces);
    mesh.surfaces.resize(std::max<std::size_t>(mesh.surfaces.size(), surfaces.back() + 1));
}

/// Triangles on a small lattice, where equal distances are common.
Mesh lattice_mesh(std::size_t count, std::uint32_t surfaces, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<int> place(0, 6);
    std::uniform_int_distribution<std::uint32_t> surface(0, surfaces - 1);
    const auto corner = [&] {
        return Point3{double(place(random)), double(place(random)), double(place(random))};
    };
    Mesh mesh;
    for (std::size_t t = 0; t < count; ++t) {
        std::vector<std::uint32_t> of{surface(random)};
        if (t % 5 == 0) of.push_back(surface(random));
        std::ranges::sort(of);
        of.erase(std::unique(of.begin(), of.end()), of.end());
        add_triangle(mesh, {corner(), corner(), corner()}, of);
    }
    return mesh;
}

std::optional<NearestSurface> by_looking_at_all(const Mesh& mesh, const Point3& p,
                                                std::span<const std::uint32_t> but, double bound) {
    std::tuple<double, std::uint32_t, double> best{bound, 0, 0};
    bool found = false;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = mesh.triangles[t];
        const Point3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        const Point3 low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                         std::min({a.z, b.z, c.z})},
            high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
        const double d = distance_to_triangle(p, a, b, c);
        for (const std::uint32_t s : mesh.surfaces_of[t]) {
            const std::tuple key{std::max(d, distance_to_box(p, low, high)), s, d};
            if (std::ranges::count(but, s) > 0 || !(key < best)) continue;
            best = key;
            found = true;
        }
    }
    if (!found) return std::nullopt;
    return NearestSurface{std::get<1>(best), std::get<2>(best), std::get<0>(best)};
}

/// Looks from the first corner of each triangle for the nearest other surface; returns how many nodes
/// that took for one.
double visits_per_search(const Mesh& mesh) {
    const SurfaceTree tree({mesh.vertices, mesh.triangles, mesh.surfaces_of});
    std::size_t visits = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        static_cast<void>(tree.nearest(mesh.vertices[mesh.triangles[t][0]], mesh.surfaces_of[t],
                                       infinity, &visits));
    return static_cast<double>(visits) / static_cast<double>(mesh.triangles.size());
}

} // namespace

TEST_CASE("surface tree: it finds what a look at each triangle finds", "[borders]") {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Mesh mesh = lattice_mesh(1 + seed % 60, 1 + std::uint32_t(seed) % 9, seed);
        const SurfaceTree tree({mesh.vertices, mesh.triangles, mesh.surfaces_of});
        std::mt19937_64 random(seed);
        std::uniform_int_distribution<int> place(-2, 16);
        for (int k = 0; k < 20; ++k) {
            const Point3 p{place(random) / 2.0, place(random) / 2.0, place(random) / 2.0};
            std::vector<std::uint32_t> but;
            for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s)
                if (random() % 4 == 0) but.push_back(s);
            const double bound = k % 3 == 0 ? 1 : infinity;
            const auto found = tree.nearest(p, but, bound);
            const auto expected = by_looking_at_all(mesh, p, but, bound);
            INFO(seed << " " << k);
            REQUIRE(found.has_value() == expected.has_value());
            if (!found) continue;
            CHECK(found->surface == expected->surface);
            CHECK(found->distance == expected->distance);
            CHECK(found->reach == expected->reach);
            CHECK(std::ranges::count(tree.within(p, but, found->reach), found->surface) == 1);
            std::vector<std::uint32_t> near;
            for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
                std::vector<std::uint32_t> others;
                for (std::uint32_t o = 0; o < mesh.surfaces.size(); ++o)
                    if (o != s) others.push_back(o);
                if (std::ranges::count(but, s) == 0 && by_looking_at_all(mesh, p, others, 2))
                    near.push_back(s);
            }
            const auto all = tree.within(p, but, 2);
            CHECK(std::ranges::includes(all, near));
        }
    }
}

TEST_CASE("surface tree: a search does not grow with surfaces, nor with the own one", "[borders]") {
    const auto apart = [](std::uint32_t n) { // n surfaces of one triangle
        Mesh mesh;
        for (std::uint32_t s = 0; s < n; ++s) {
            const double x = 2.0 * s;
            add_triangle(mesh, {Point3{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}, {s});
        }
        return mesh;
    };
    const auto fan = [](std::uint32_t n) { // all have a corner in common
        Mesh mesh;
        for (std::uint32_t s = 0; s < n; ++s) {
            const double a = s, b = s + 0.5;
            add_triangle(mesh, {Point3{}, {std::cos(a), std::sin(a), 0}, {0, std::sin(b), 1}}, {s});
        }
        return mesh;
    };
    const auto nested = [](std::uint32_t n) { // each in the next
        Mesh mesh;
        for (std::uint32_t s = 0; s < n; ++s) {
            const double r = s + 1;
            add_triangle(mesh, {Point3{-r, 0, -r}, {r, 0, -r}, {0, 0, r}}, {s});
        }
        return mesh;
    };
    const auto two = [](std::uint32_t n) { // two large surfaces, far from each other
        Mesh mesh;
        const auto side = static_cast<std::uint32_t>(std::sqrt(n / 2));
        for (std::uint32_t i = 0; i < side * side; ++i)
            for (const std::uint32_t s : {0U, 1U}) {
                const double x = i / side, y = i % side, z = 30.0 * s;
                add_triangle(mesh, {Point3{x, y, z}, {x + 1, y, z}, {x, y + 1, z}}, {s});
            }
        return mesh;
    };
    for (const std::uint32_t n : {1000U, 4000U}) {
        INFO(n);
        CHECK(visits_per_search(apart(n)) < 60);
        CHECK(visits_per_search(fan(n)) < 200);
        CHECK(visits_per_search(nested(n)) < 200);
        CHECK(visits_per_search(two(n)) < 200);
    }
}
