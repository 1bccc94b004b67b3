// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The points of an exact part, in rationals and by formulas of their own.
#include <array>
#include <cstddef>

#include <gmpxx.h>

#include "forge_meaning.hpp"

namespace terrane::fuzz {

namespace {

using Exact3 = std::array<mpq_class, 3>;

Exact3 exact_point(const Point3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}
Exact3 minus(const Exact3& a, const Exact3& b) {
    return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
Exact3 exact_cross(const Exact3& a, const Exact3& b) {
    return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
            mpq_class(a[0] * b[1] - a[1] * b[0])};
}
mpq_class exact_dot(const Exact3& a, const Exact3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns where the line through p and q meets the plane through a with this normal.
Exact3 on_plane(const Exact3& p, const Exact3& q, const Exact3& a, const Exact3& normal) {
    const Exact3 along_line = minus(q, p);
    const mpq_class share = exact_dot(normal, minus(a, p)) / exact_dot(normal, along_line);
    Exact3 result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = p[i] + share * along_line[i];
    return result;
}

Exact3 constructed(const Construction& how, const std::vector<Point3>& inputs) {
    const auto v = [&](std::size_t i) { return exact_point(inputs[how.v[i]]); };
    const auto normal = [&](std::size_t i) {
        return exact_cross(minus(v(i + 1), v(i)), minus(v(i + 2), v(i)));
    };
    switch (how.kind) {
    case Construction::Kind::input:
        return v(0);
    case Construction::Kind::line_plane:
        return on_plane(v(0), v(1), v(2), normal(2));
    case Construction::Kind::line_line: {
        Exact3 axis;
        axis[static_cast<std::size_t>(how.axis)] = 1;
        return on_plane(v(0), v(1), v(2), exact_cross(minus(v(3), v(2)), axis));
    }
    default: { // the planes n_k p = d_k meet in sum d_k (n_k+1 x n_k+2) / det
        const std::array<Exact3, 3> n{normal(0), normal(3), normal(6)};
        const mpq_class determinant = exact_dot(n[0], exact_cross(n[1], n[2]));
        Exact3 result;
        for (std::size_t k = 0; k < 3; ++k) {
            const mpq_class d = exact_dot(n[k], v(3 * k)) / determinant;
            const Exact3 other = exact_cross(n[(k + 1) % 3], n[(k + 2) % 3]);
            for (std::size_t i = 0; i < 3; ++i) result[i] += d * other[i];
        }
        return result;
    }
    }
}

} // namespace

std::vector<Point3> points_of_exact(const std::vector<Surface>& surfaces,
                                    const ArrangementClaim& exact) {
    std::vector<Point3> inputs;
    for (const Surface& surface : surfaces)
        inputs.insert(inputs.end(), surface.vertices.begin(), surface.vertices.end());
    std::vector<Point3> points;
    for (const Construction& how : exact.vertices) {
        const Exact3 p = constructed(how, inputs);
        points.push_back({p[0].get_d(), p[1].get_d(), p[2].get_d()});
    }
    return points;
}

} // namespace terrane::fuzz
