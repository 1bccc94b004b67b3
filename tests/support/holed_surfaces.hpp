// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sheets of known shape, and holes in them.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace test_support {

using terrane::Point3;
using terrane::Role;
using terrane::Surface;
using terrane::Triangle;

/// A point of the sheet for parameters u, v.
using Shape = std::function<Point3(double u, double v)>;

inline Shape graph(std::function<double(double, double)> height) {
    return [height = std::move(height)](double u, double v) { return Point3{u, v, height(u, v)}; };
}

/// The sheet over [u0, u1] x [v0, v1] with n x m cells; inner nodes moved by up to `jitter` cells.
inline Surface sheet(const Shape& shape, double u0, double v0, double u1, double v1, unsigned n,
                     unsigned m, double jitter = 0, unsigned seed = 1) {
    Surface s{"sheet", Role::horizon, {}, {}};
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> move(-jitter, jitter);
    const double du = (u1 - u0) / n, dv = (v1 - v0) / m;
    for (unsigned j = 0; j <= m; ++j)
        for (unsigned i = 0; i <= n; ++i) {
            const bool inner = i > 0 && i < n && j > 0 && j < m && jitter > 0;
            const double a = inner ? move(random) : 0, b = inner ? move(random) : 0;
            s.vertices.push_back(shape(u0 + (i + a) * du, v0 + (j + b) * dv));
        }
    for (std::uint32_t j = 0; j < m; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
            if ((i + j) % 2 == 0) {
                s.triangles.push_back({a, b, c});
                s.triangles.push_back({a, c, d});
            } else {
                s.triangles.push_back({a, b, d});
                s.triangles.push_back({b, c, d});
            }
        }
    return s;
}

/// Without the triangles of which `gone` holds, by the mean of their corners.
inline Surface punched(Surface s, const std::function<bool(const Point3&)>& gone) {
    std::erase_if(s.triangles, [&](const Triangle& t) {
        const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
        return gone({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3});
    });
    return s;
}

inline std::function<bool(const Point3&)> disk(double x, double y, double r) {
    return [=](const Point3& p) { return std::hypot(p.x - x, p.y - y) < r; };
}

} // namespace test_support
