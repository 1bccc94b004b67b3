// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces that enclose or divide volumes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace test_support {

using terrane::Point3;
using terrane::Role;
using terrane::Surface;
using terrane::Triangle;

/// Appends a quadrilateral a b c d as two triangles.
inline void add_quad(Surface& s, const Point3& a, const Point3& b, const Point3& c,
                     const Point3& d) {
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    s.vertices.insert(s.vertices.end(), {a, b, c, d});
    s.triangles.push_back({first, first + 1, first + 2});
    s.triangles.push_back({first, first + 2, first + 3});
}

inline Surface quad(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                    std::string name = "quad") {
    Surface s{std::move(name), Role::unknown, {}, {}};
    add_quad(s, a, b, c, d);
    return s;
}

/// Returns the six sides of a box, oriented outward.
inline Surface box(const Point3& l, const Point3& h, std::string name = "box") {
    Surface s{std::move(name), Role::unknown, {}, {}};
    add_quad(s, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z});
    add_quad(s, {l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
    add_quad(s, {l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
    add_quad(s, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z});
    add_quad(s, {h.x, h.y, l.z}, {l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z});
    add_quad(s, {l.x, h.y, l.z}, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z});
    return s;
}

inline Surface cube(double low, double high, std::string name = "cube") {
    return box({low, low, low}, {high, high, high}, std::move(name));
}

/// Returns the horizontal rectangle [x0, x1] x [y0, y1] at height z.
inline Surface level(double z, double x0, double y0, double x1, double y1,
                     std::string name = "level") {
    return quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}, std::move(name));
}

inline Surface tetrahedron(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                           std::string name = "tetrahedron") {
    return {
        std::move(name), Role::unknown, {a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

/// Returns a ring around `axis` (2: z) of n pieces with a square section.
inline Surface torus(const Point3& centre, double large, double small, unsigned n, int axis = 2,
                     std::string name = "torus") {
    Surface s{std::move(name), Role::unknown, {}, {}};
    const double pi = std::acos(-1.0);
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < 4; ++j) {
            const double a = 2 * pi * i / n, b = 2 * pi * j / 4;
            const double r = large + small * std::cos(b), up = small * std::sin(b);
            const double u = r * std::cos(a), v = r * std::sin(a);
            std::array<double, 3> p{};
            p[static_cast<std::size_t>(axis)] = up;
            p[static_cast<std::size_t>((axis + 1) % 3)] = u;
            p[static_cast<std::size_t>((axis + 2) % 3)] = v;
            s.vertices.push_back({centre.x + p[0], centre.y + p[1], centre.z + p[2]});
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < 4; ++j) {
            const auto at = [&](std::uint32_t k, std::uint32_t l) { return (k % n) * 4 + l % 4; };
            s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return s;
}

/// Returns a strip with one half turn, which has only one side.
inline Surface moebius_strip(unsigned n = 12, std::string name = "moebius") {
    Surface s{std::move(name), Role::unknown, {}, {}};
    const double pi = std::acos(-1.0);
    for (unsigned i = 0; i < n; ++i)
        for (const double side : {-1.0, 1.0}) {
            const double a = 2 * pi * i / n, r = 4 + side * std::cos(a / 2);
            s.vertices.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(a / 2)});
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n;
        const std::uint32_t a = 2 * i, b = 2 * i + 1, c = last ? 1 : a + 2, d = last ? 0 : b + 2;
        s.triangles.push_back({a, c, d});
        s.triangles.push_back({a, d, b});
    }
    return s;
}

/// Returns two pyramids on one square: eight triangles around a centre.
inline Surface octahedron(const Point3& c, double r, std::string name = "octahedron") {
    Surface s{std::move(name),
              Role::unknown,
              {{c.x + r, c.y, c.z},
               {c.x - r, c.y, c.z},
               {c.x, c.y + r, c.z},
               {c.x, c.y - r, c.z},
               {c.x, c.y, c.z + r},
               {c.x, c.y, c.z - r}},
              {}};
    for (const Triangle t :
         {Triangle{0, 2, 4}, Triangle{2, 1, 4}, Triangle{1, 3, 4}, Triangle{3, 0, 4},
          Triangle{2, 0, 5}, Triangle{1, 2, 5}, Triangle{3, 1, 5}, Triangle{0, 3, 5}})
        s.triangles.push_back(t);
    return s;
}

} // namespace test_support
