// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random models of planes, sheets, polyhedra and dangling pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "support/points.hpp"
#include "support/solids.hpp"

namespace test_support {

/// Makes models with coordinates on a small lattice (most of them degenerate), on a fine one, or
/// with any coordinates.
class ModelMaker {
public:
    explicit ModelMaker(std::uint64_t seed) : random(seed), kind_(random_int(random, 0, 2)) {}

    double number(int most) {
        if (kind_ == 0) return random_int(random, -most, most);
        if (kind_ == 1) return random_int(random, -10 * most, 10 * most) * 0.1;
        return random_real(random, -most, most);
    }
    Point3 point(int most) {
        return point_of([&] { return number(most); });
    }
    Surface plane() {
        Surface s{"plane", Role::unknown, {}, {}};
        const Point3 c = point(2), u = point(8), v = point(8);
        const auto at = [&](double i, double j) {
            return Point3{c.x + i * u.x + j * v.x, c.y + i * u.y + j * v.y,
                          c.z + i * u.z + j * v.z};
        };
        s.vertices = {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
        s.triangles = {{0, 1, 2}, {0, 2, 3}};
        return s;
    }
    Surface sheet() {
        Surface s{"sheet", Role::unknown, {}, {}};
        constexpr std::uint32_t n = 3;
        const double step = 2 * (kind_ == 0 ? 2 : number(2));
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j)
                s.vertices.push_back({(i - 1.5) * step, (j - 1.5) * step, number(1)});
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j) {
                const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
                s.triangles.push_back({a, b, b + 1});
                s.triangles.push_back({a, b + 1, a + 1});
            }
        return s;
    }
    Surface solid() {
        switch (random_int(random, 0, 3)) {
        case 0:
            return tetrahedron(point(4), point(4), point(4), point(4));
        case 1:
            return octahedron(point(3), number(3));
        case 2:
            return torus(point(2), 3, 1, 4, random_int(random, 0, 2));
        default:
            return box(point(3), point(4));
        }
    }
    Surface dangling() {
        return {"piece", Role::unknown, {point(4), point(4), point(4)}, {{0, 1, 2}}};
    }
    std::vector<Surface> model() {
        std::vector<Surface> all;
        const auto add = [&](int most, auto make) {
            for (int i = random_int(random, 0, most); i > 0; --i) all.push_back((this->*make)());
        };
        add(2, &ModelMaker::plane);
        add(1, &ModelMaker::sheet);
        add(3, &ModelMaker::solid);
        add(2, &ModelMaker::dangling);
        if (all.empty()) all.push_back(solid());
        return all;
    }

    Random random;

private:
    int kind_;
};

} // namespace test_support
