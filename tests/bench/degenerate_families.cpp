// SPDX-License-Identifier: LGPL-3.0-or-later
#include "degenerate_families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace bench {

using namespace terrane;

namespace {

constexpr double half_turn = 3.14159265358979;

void add(Surface& s, const Point3& a, const Point3& b, const Point3& c) {
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    s.vertices.insert(s.vertices.end(), {a, b, c});
    s.triangles.push_back({first, first + 1, first + 2});
}

void add(Surface& s, const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    add(s, a, b, c);
    add(s, a, c, d);
}

/// A random integer from 0 to high, the same on each machine.
double pick(std::mt19937& random, unsigned high) {
    return static_cast<double>(random() % (high + 1));
}

/// Whether a triangle of small integers has an area.
bool is_proper(const Point3& a, const Point3& b, const Point3& c) {
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const double wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
    return uy * wz != uz * wy || uz * wx != ux * wz || ux * wy != uy * wx;
}

/// n rectangles of two triangles, in planes through the z axis.
std::vector<Surface> star(int n) {
    Surface s;
    for (int i = 0; i < n; ++i) {
        const double angle = half_turn * i / n, x = std::cos(angle), y = std::sin(angle);
        add(s, {-x, -y, 0}, {x, y, 0}, {x, y, 1}, {-x, -y, 1});
    }
    return {s};
}

/// n triangles in planes through the x axis; their sides on it overlap at random.
std::vector<Surface> collinear(int n) {
    constexpr unsigned extent = 10'000;
    Surface s;
    std::mt19937 random(1);
    for (int i = 0; i < n; ++i) {
        const double angle = half_turn * i / n, from = pick(random, extent),
                     to = from + 1 + pick(random, extent);
        add(s, {from, 0, 0}, {to, 0, 0},
            {from, extent * std::cos(angle), extent * std::sin(angle)});
    }
    return {s};
}

/// n coplanar triangles, each of which contains the one before.
std::vector<Surface> nested(int n) {
    Surface s;
    for (int i = 1; i <= n; ++i) {
        const double d = i;
        add(s, {0, 0, 0}, {d, 0, 0}, {0, d, 0});
    }
    return {s};
}

/// n triangles, nested in two planes that cross.
std::vector<Surface> crossing_stacks(int n) {
    Surface s;
    for (int i = 1; i <= n / 2; ++i) {
        const double d = i;
        add(s, {-d, -1, 0}, {d, -1, 0}, {0, 2 * d, 0});
        add(s, {0, -d, -1}, {0, d, -1}, {0, 0.5, d});
    }
    return {s};
}

/// n random triangles on a lattice.
std::vector<Surface> lattice(int n, std::array<unsigned, 3> high) {
    std::mt19937 random(7);
    Surface s;
    while (s.triangles.size() < static_cast<std::size_t>(n)) {
        std::array<Point3, 3> t;
        for (Point3& p : t) {
            p.x = pick(random, high[0]);
            p.y = pick(random, high[1]);
            p.z = pick(random, high[2]);
        }
        if (is_proper(t[0], t[1], t[2])) add(s, t[0], t[1], t[2]);
    }
    return {s};
}

std::vector<Surface> flat_lattice(int n) {
    return lattice(n, {20, 20, 0});
}

std::vector<Surface> small_lattice(int n) {
    return lattice(n, {2, 2, 2});
}

/// n triangles at one edge.
std::vector<Surface> fan(int n) {
    Surface s;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * half_turn * i / n;
        add(s, {0, 0, 0}, {0, 0, 1}, {std::cos(angle), std::sin(angle), 0.5});
    }
    return {s};
}

/// n triangles at one vertex, on cones that meet nowhere else.
std::vector<Surface> one_vertex(int n) {
    Surface s;
    constexpr int per_cone = 50;
    for (int i = 0; i < n; ++i) {
        const double first = 2 * half_turn * (i % per_cone) / per_cone;
        const double second = first + half_turn / per_cone;
        const int cone = i / per_cone;
        const double z = 0.25 + cone;
        add(s, {0, 0, 0}, {std::cos(first), std::sin(first), z},
            {std::cos(second), std::sin(second), z});
    }
    return {s};
}

/// n boxes on each other, each shifted by a little.
std::vector<Surface> slabs(int n) {
    Surface s;
    for (int i = 0; i < n; ++i) {
        const double x = 0.25 * i, z = i;
        const std::array<Point3, 4> below{{{x, 0, z}, {x + 8, 0, z}, {x + 8, 8, z}, {x, 8, z}}};
        auto above = below;
        for (Point3& p : above) p.z = z + 1;
        add(s, below[0], below[3], below[2], below[1]);
        add(s, above[0], above[1], above[2], above[3]);
        for (std::size_t k = 0; k < 4; ++k)
            add(s, below[k], below[(k + 1) % 4], above[(k + 1) % 4], above[k]);
    }
    return {s};
}

/// Two coplanar combs of n teeth, across each other.
std::vector<Surface> combs(int n) {
    Surface s;
    for (int i = 0; i < n; ++i) {
        const double d = i, m = n + 1;
        add(s, {d, -1, 0}, {d + 0.5, -1, 0}, {d + 0.25, m, 0});
        add(s, {-1, d, 0}, {-1, d + 0.5, 0}, {m, d + 0.25, 0});
    }
    return {s};
}

/// n copies of two sheets that cross, as of a file that is named n times.
std::vector<Surface> copies(int n) {
    Surface s;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            const double x = i, y = j;
            add(s, {x, y, 0.5}, {x + 1, y, 0.5}, {x + 1, y + 1, 0.5}, {x, y + 1, 0.5});
            add(s, {x, 2.25, y - 3}, {x + 1, 2.25, y - 3}, {x + 1, 2.25, y - 2}, {x, 2.25, y - 2});
        }
    return std::vector<Surface>(static_cast<std::size_t>(n), s);
}

constexpr std::array all{
    Family{"star", 125, star},
    Family{"collinear", 100, collinear},
    Family{"nested", 250, nested},
    Family{"crossing-stacks", 250, crossing_stacks},
    Family{"flat-lattice", 50, flat_lattice},
    Family{"small-lattice", 300, small_lattice},
    Family{"fan", 500, fan},
    Family{"one-vertex", 500, one_vertex},
    Family{"slabs", 100, slabs},
    Family{"combs", 25, combs},
    Family{"copies", 100, copies},
};

} // namespace

std::span<const Family> families() {
    return all;
}

} // namespace bench
