// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Grids and sheets of known shape, and holes in them.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace test_support {

using terrane::Point3;
using terrane::Role;
using terrane::Surface;
using terrane::Triangle;

/// Returns a grid of columns x rows cells, each divided into two triangles that face up.
/// `node`(i, j) is the point in column i and row j; the vertices are numbered row by row.
template <class Node>
Surface grid(unsigned columns, unsigned rows, const Node& node, std::string name = "",
             Role role = Role::unknown) {
    Surface s{std::move(name), role, {}, {}};
    for (unsigned j = 0; j <= rows; ++j)
        for (unsigned i = 0; i <= columns; ++i) s.vertices.push_back(node(i, j));
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = j * (columns + 1) + i, d = a + columns + 1;
            s.triangles.push_back({a, a + 1, d + 1});
            s.triangles.push_back({a, d + 1, d});
        }
    return s;
}

/// Returns a grid whose nodes are the points at(u, v), with u and v in [0, 1].
template <class At>
Surface unit_grid(unsigned columns, unsigned rows, const At& at, std::string name = "") {
    const auto node = [&](unsigned i, unsigned j) {
        return at(double(i) / columns, double(j) / rows);
    };
    return grid(columns, rows, node, std::move(name));
}

/// Returns the sheet over [0, columns * step] x [0, rows * step] that has only the cells with
/// keep(column, row), each divided into two triangles that face up. `point`(x, y) is the vertex
/// over (x, y); there are only vertices that a triangle uses.
template <class Keep, class At>
Surface sheet_of(int columns, int rows, double step, const Keep& keep, const At& point) {
    Surface s{"sheet", Role::horizon, {}, {}};
    std::map<std::pair<int, int>, std::uint32_t> known;
    const auto vertex = [&](int i, int j) {
        const auto [at, added] =
            known.try_emplace({i, j}, static_cast<std::uint32_t>(s.vertices.size()));
        if (added) s.vertices.push_back(point(i * step, j * step));
        return at->second;
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            if (!keep(i, j)) continue;
            const auto a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                       d = vertex(i, j + 1);
            s.triangles.push_back({a, b, c});
            s.triangles.push_back({a, c, d});
        }
    return s;
}

/// Returns the sheet_of with heights z(x, y).
template <class Keep, class Height>
Surface sheet(int columns, int rows, double step, const Keep& keep, const Height& z) {
    return sheet_of(columns, rows, step, keep, [&](double x, double y) {
        return Point3{x, y, z(x, y)};
    });
}

/// Keeps all but the cells whose middle is within `radius` cells of (column, row).
inline auto without_disc(double column, double row, double radius) {
    return [=](int i, int j) { return std::hypot(i + 0.5 - column, j + 0.5 - row) > radius; };
}

/// Maps the parameters u and v of a sheet to a point.
using SheetShape = std::function<Point3(double u, double v)>;

inline SheetShape graph(std::function<double(double, double)> height) {
    return [height = std::move(height)](double u, double v) { return Point3{u, v, height(u, v)}; };
}

/// Returns the sheet over [u0, u1] x [v0, v1] with n x m cells, whose diagonals alternate; inner
/// nodes are moved by up to `jitter` cells.
inline Surface sheet(const SheetShape& shape, double u0, double v0, double u1, double v1,
                     unsigned n, unsigned m, double jitter = 0, unsigned seed = 1) {
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

/// Removes the triangles whose centroid satisfies `gone`.
inline Surface punched(Surface s, const std::function<bool(const Point3&)>& gone) {
    std::erase_if(s.triangles, [&](const Triangle& t) {
        const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
        return gone({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3});
    });
    return s;
}

/// Tells whether a point lies less than r from the vertical line through (x, y).
inline std::function<bool(const Point3&)> disk(double x, double y, double r) {
    return [=](const Point3& p) { return std::hypot(p.x - x, p.y - y) < r; };
}

/// Returns a sheet of 24 x 24 cells of size 10, in one row of which it climbs by `lift`, with a
/// hole across this cliff.
inline Surface cliff(double lift) {
    return punched(sheet(graph([=](double x, double) {
                             return 10 * std::sin(x / 40) + (x > 115 ? lift : 0.0);
                         }),
                         0, 0, 240, 240, 24, 24),
                   disk(115, 110, 52));
}

/// Returns twice the area of a triangle seen along z, positive if it is counterclockwise.
inline double doubled_area(std::span<const Point3> p, const Triangle& t) {
    return (p[t[1]].x - p[t[0]].x) * (p[t[2]].y - p[t[0]].y) -
           (p[t[1]].y - p[t[0]].y) * (p[t[2]].x - p[t[0]].x);
}

inline double doubled_area(std::span<const Point3> p, const std::vector<Triangle>& triangles) {
    double sum = 0;
    for (const Triangle& t : triangles) sum += doubled_area(p, t);
    return sum;
}

} // namespace test_support
