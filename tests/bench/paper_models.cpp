// SPDX-License-Identifier: LGPL-3.0-or-later
#include "paper_models.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace terrane::models {
namespace {

using Map = std::function<Point3(double, double)>;
using Vector = std::array<double, 3>;

struct Interval {
    double low, high;
};

/// A parametric surface: the rectangle of its parameters, and the map to space.
struct Patch {
    std::string name;
    Role role;
    Interval u, v;
    Map map;
};

Patch horizon() {
    return {"horizon", Role::horizon, {0, 4}, {0, 4}, [](double x, double y) {
                return Point3{x, y, 0.1 * std::sin(3 * x) * std::cos(2 * y)};
            }};
}

Patch fault() {
    return {"fault", Role::fault, {0.0123, 3.9871}, {-1, 1}, [](double x, double z) {
                return Point3{x, 2 + 0.2 * std::sin(2 * x) + 0.3 * z, z};
            }};
}

Patch waves() {
    return {"waves", Role::horizon, {0, 4}, {0, 4}, [](double x, double y) {
                return Point3{x, y, 0.3 * std::sin(5 * x) * std::sin(5 * y)};
            }};
}

Patch turned_waves() {
    return {"turned waves", Role::horizon, {0, 4}, {0, 4}, [](double u, double v) {
                const double c = std::cos(0.1), s = std::sin(0.1);
                const double x = 2 + c * (u - 2) - s * (v - 2);
                const double y = 2 + s * (u - 2) + c * (v - 2);
                return Point3{x, y, 0.3 * std::cos(4 * x + 0.3) * std::sin(6 * y + 0.2)};
            }};
}

/// Adds the vertices of m x n cells, row by row.
void add_vertices(Surface& s, int m, int n, const Patch& p) {
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= m; ++i)
            s.vertices.push_back(p.map(p.u.low + (p.u.high - p.u.low) * i / m,
                                       p.v.low + (p.v.high - p.v.low) * j / n));
}

void add_cell(Surface& s, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    s.triangles.push_back({a, b, d});
    s.triangles.push_back({a, d, c});
}

/// Adds m x n cells whose first vertex is `base`, `row` vertices to a row.
void add_cells(Surface& s, int m, int n, int base, int row) {
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < m; ++i) {
            const auto a = static_cast<std::uint32_t>(base + j * row + i);
            const auto c = a + static_cast<std::uint32_t>(row);
            add_cell(s, a, a + 1, c, c + 1);
        }
}

Surface uniform(int m, int n, const Patch& p) {
    Surface s{p.name, p.role, {}, {}};
    add_vertices(s, m, n, p);
    add_cells(s, m, n, 0, m + 1);
    return s;
}

/// Makes coarse cells on the left and fine ones on the right; the last coarse column consists of
/// fans to the fine vertices.
Surface half_refined(int m, int n, const Patch& p) {
    constexpr int r = 30;
    Surface s{p.name, p.role, {}, {}};
    const double middle = (p.u.low + p.u.high) / 2;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i < m; ++i)
            s.vertices.push_back(p.map(p.u.low + (middle - p.u.low) * i / m,
                                       p.v.low + (p.v.high - p.v.low) * j / n));
    const auto fine = static_cast<std::uint32_t>(s.vertices.size());
    Patch right = p;
    right.u.low = middle;
    add_vertices(s, r * m, r * n, right);
    const auto row = static_cast<std::uint32_t>(r * m + 1);
    for (int j = 0; j < n; ++j) {
        const auto a = static_cast<std::uint32_t>(j * m), c = a + static_cast<std::uint32_t>(m);
        const auto last = static_cast<std::uint32_t>(m - 1);
        for (std::uint32_t i = 0; i < last; ++i) add_cell(s, a + i, a + i + 1, c + i, c + i + 1);
        auto f = fine + static_cast<std::uint32_t>(j * r) * row;
        for (int k = 0; k < r; ++k, f += row) s.triangles.push_back({a + last, f, f + row});
        s.triangles.push_back({a + last, f, c + last});
    }
    add_cells(s, r * m, r * n, static_cast<int>(fine), r * m + 1);
    return s;
}

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void normalise(Vector& v) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (double& x : v) x /= length;
}

Surface square(const Vector& centre, const Vector& a, const Vector& b, double half) {
    Surface s{"square", Role::unknown, {}, {{0, 1, 2}, {0, 2, 3}}};
    for (const auto& [u, v] : {std::pair{-half, -half}, std::pair{half, -half},
                               std::pair{half, half}, std::pair{-half, half}})
        s.vertices.push_back({centre[0] + u * a[0] + v * b[0], centre[1] + u * a[1] + v * b[1],
                              centre[2] + u * a[2] + v * b[2]});
    return s;
}

} // namespace

std::vector<Surface> pair_1(const Resolution& r) {
    return {uniform(r.horizon, r.horizon, horizon()), uniform(r.fault_x, r.fault_z, fault())};
}

std::vector<Surface> pair_2(const Resolution& r) {
    return {uniform(r.horizon, r.horizon, waves()), uniform(r.horizon, r.horizon, turned_waves())};
}

std::vector<Surface> nonuniform_1() {
    return {half_refined(4, 6, horizon()), half_refined(4, 6, fault())};
}

std::vector<Surface> nonuniform_2() {
    return {half_refined(3, 6, waves()), half_refined(3, 6, turned_waves())};
}

std::vector<Surface> random_squares(const RandomSquares& s) {
    std::mt19937_64 random(s.seed);
    std::uniform_real_distribution<double> place(s.low, s.high);
    std::normal_distribution<double> normal;
    std::vector<Surface> surfaces;
    for (int i = 0; i < s.count; ++i) {
        Vector centre{}, a{}, b{};
        for (double& x : centre) x = place(random);
        for (double& x : a) x = normal(random);
        normalise(a);
        for (double& x : b) x = normal(random);
        const double d = dot(a, b);
        for (unsigned k = 0; k < 3; ++k) b[k] -= d * a[k];
        normalise(b);
        surfaces.push_back(square(centre, a, b, s.half_side));
    }
    return surfaces;
}

} // namespace terrane::models
