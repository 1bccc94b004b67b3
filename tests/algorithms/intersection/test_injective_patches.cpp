// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests each pair of triangles within a patch: no two may meet improperly.
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <map>

namespace {

using namespace terrane;
using namespace test_support;

struct Sheet {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
};

enum class Shape {
    smooth,  ///< a height field
    jagged,  ///< grid vertices also moved sideways: folds
    lattice, ///< likewise on a lattice: folds that touch
    rolled,  ///< a spiral: several windings, locally one-to-one
    holed,   ///< a height field with triangles missing: loops that share vertices
    touching ///< a height field bent until its border touches itself
};

constexpr std::array all_shapes{Shape::smooth, Shape::jagged, Shape::lattice,
                                Shape::rolled, Shape::holed,  Shape::touching};

Point3 place(Random& random, Shape shape, double u, double v, int n) {
    const auto real = [&](double size) { return random_real(random, -size, size); };
    switch (shape) {
    case Shape::jagged:
        return {u + real(0.8), v + real(0.8), real(1)};
    case Shape::lattice:
        return {u + random_int(random, -1, 1), v + random_int(random, -1, 1),
                double(random_int(random, 0, 1))};
    case Shape::rolled: {
        const double angle = 4 * u / n * 3.3, radius = 3 + 0.2 * angle + 0.05 * v;
        return {radius * std::cos(angle), radius * std::sin(angle), 0.3 * v + real(0.01)};
    }
    case Shape::touching:
        return {std::abs(u - n / 2.0), v, random_int(random, 0, 1) * u / 4};
    default:
        return {u, v, real(1)};
    }
}

Sheet random_mesh(Random& random, Shape shape) {
    Sheet m;
    const int n = random_int(random, 1, 6);
    std::map<Point3, std::uint32_t> index; // distinct points
    std::vector<std::uint32_t> at;
    for (int v = 0; v <= n; ++v)
        for (int u = 0; u <= n; ++u) {
            const Point3 p = place(random, shape, u, v, n);
            const auto [it, fresh] =
                index.try_emplace(p, static_cast<std::uint32_t>(m.points.size()));
            if (fresh) m.points.push_back(p);
            at.push_back(it->second);
        }
    std::map<Triangle, bool> seen;
    const auto add = [&](int a, int b, int c) {
        Triangle t{at[static_cast<std::size_t>(a)], at[static_cast<std::size_t>(b)],
                   at[static_cast<std::size_t>(c)]};
        if (random_int(random, 0, 3) == 0) std::swap(t[0], t[1]); // orientation is free
        Triangle key = t;
        std::sort(key.begin(), key.end());
        const bool flat = collinear(m.points[t[0]], m.points[t[1]], m.points[t[2]]);
        const bool dropped = shape == Shape::holed && random_int(random, 0, 3) == 0;
        if (!flat && !dropped && seen.try_emplace(key, true).second) m.triangles.push_back(t);
    };
    for (int v = 0; v < n; ++v)
        for (int u = 0; u < n; ++u) {
            const int a = v * (n + 1) + u, up = a + n + 1;
            add(a, a + 1, up);
            add(a + 1, up + 1, up);
        }
    return m;
}

struct Found {
    int proven = 0; ///< triangles in a patch
    int unproven = 0;
    int missed = 0; ///< improper pairs within one patch
};

Found examine(const Sheet& m) {
    const std::vector<std::uint32_t> surface_of(m.triangles.size(), 0);
    const auto edges = group_edges(m.triangles, m.points.size());
    const InjectivePatches patches =
        find_injective_patches(m.points, m.triangles, surface_of, edges);
    Found found;
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
        ++(patches.of[i] == no_group ? found.unproven : found.proven);
        for (std::size_t j = i + 1; j < m.triangles.size(); ++j)
            found.missed += patches.of[i] != no_group && patches.of[i] == patches.of[j] &&
                            improper_contact(m.points, m.triangles[i], m.triangles[j]).has_value();
    }
    return found;
}

} // namespace

TEST_CASE("patches: no two triangles of a patch meet improperly") {
    Random random(101);
    for (const Shape shape : all_shapes) {
        Found all;
        for (int i = 0; i < cases(1500); ++i) {
            const Found found = examine(random_mesh(random, shape));
            INFO("shape " << static_cast<int>(shape) << ", mesh " << i);
            REQUIRE(found.missed == 0);
            all.proven += found.proven;
            all.unproven += found.unproven;
        }
        CHECK(all.proven > 0);
        if (shape == Shape::smooth) CHECK(all.unproven == 0);
    }
}

TEST_CASE("patches: scattered triangles are proven one by one") {
    Random random(92);
    Sheet m;
    for (std::uint32_t k = 0; k < 100; ++k) { // all overlap in every projection
        const auto family = [&] { return point_of([&] { return random_real(random, 0, 1); }); };
        for (int i = 0; i < 3; ++i) m.points.push_back(family());
        m.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    std::vector<std::uint32_t> surface_of(m.triangles.size(), 0);
    const EdgeSides edges = group_edges(m.triangles, m.points.size());
    const InjectivePatches patches =
        find_injective_patches(m.points, m.triangles, surface_of, edges);
    std::vector<std::uint32_t> groups = patches.of;
    std::sort(groups.begin(), groups.end());
    CHECK(std::adjacent_find(groups.begin(), groups.end()) == groups.end());
    CHECK(groups.back() != no_group);
}
