// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/sharpest_angle.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

/// Returns q - p times a power of two by which squares of it are doubles.
Point3 direction(const Point3& p, const Point3& q) {
    const Point3 d = minus(q, p);
    const double size = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
    if (!(size > 0) || !std::isfinite(size)) return d;
    const int to_one = -std::ilogb(size);
    return {std::ldexp(d.x, to_one), std::ldexp(d.y, to_one), std::ldexp(d.z, to_one)};
}

/// Returns the direction away from the edge p q in the plane of the triangle p q r.
Point3 away(const Point3& p, const Point3& q, const Point3& r) {
    const Point3 e = direction(p, q), d = direction(p, r);
    const double share = dot(d, e) / dot(e, e);
    return {d.x - share * e.x, d.y - share * e.y, d.z - share * e.z};
}

double degrees_between(const Point3& u, const Point3& v) {
    const Point3 n = cross(u, v);
    return std::atan2(std::hypot(n.x, n.y, n.z), dot(u, v)) * 180 / std::acos(-1.0);
}

} // namespace

std::optional<SharpAngle> sharpest_angle(const Mesh& mesh) {
    std::optional<SharpAngle> sharpest;
    std::vector<Point3> directions;
    group_edges(mesh.triangles, mesh.vertices.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            const Point3 &p = mesh.vertices[low], &q = mesh.vertices[high];
            directions.clear();
            for (const auto& side : sides) {
                const auto& [a, b, c] = mesh.triangles[side.triangle];
                directions.push_back(away(p, q, mesh.vertices[a ^ b ^ c ^ low ^ high]));
            }
            for (std::size_t i = 0; i < directions.size(); ++i)
                for (std::size_t j = i + 1; j < directions.size(); ++j) {
                    const double angle = degrees_between(directions[i], directions[j]);
                    if (std::isnan(angle) || (sharpest && angle >= sharpest->degrees)) continue;
                    sharpest = {
                        angle,
                        {p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2, p.z + (q.z - p.z) / 2}};
                }
        });
    return sharpest;
}

ShortEdge shortest_edge(const Mesh& mesh) {
    ShortEdge shortest{HUGE_VAL, {}};
    for (const Triangle& corners : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Point3 &p = mesh.vertices[corners[k]], &q = mesh.vertices[corners[(k + 1) % 3]];
            const double length = std::hypot(q.x - p.x, q.y - p.y, q.z - p.z);
            if (length < shortest.length)
                shortest = {length,
                            {p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2, p.z + (q.z - p.z) / 2}};
        }
    return shortest;
}

} // namespace terrane
