// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/volumes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr std::size_t most_triangles = 24; ///< of a block, tried to find its point

using Vector3 = polynomial::Vector<double>;

Vector3 from_to(const Point3& a, const Point3& b) {
    return {b.x - a.x, b.y - a.y, b.z - a.z};
}

Point3 moved(const Point3& p, const Vector3& v, double share) {
    return {p.x + share * v.x, p.y + share * v.y, p.z + share * v.z};
}

/// Returns points far outside the mesh, in directions that are unlikely to hit edges.
std::vector<Point3> ends_outside(const Mesh& mesh, const Point3& from) {
    double reach = 1;
    for (const Point3& p : mesh.vertices)
        reach = std::max(
            {reach, std::fabs(p.x - from.x), std::fabs(p.y - from.y), std::fabs(p.z - from.z)});
    constexpr std::array<Vector3, 6> directions{{{0.1234567, 0.0765432, 3},
                                                 {-0.213243, 0.157913, -3},
                                                 {3, 0.1928374, 0.0918273},
                                                 {-3, 0.271828, -0.314159},
                                                 {0.314151, 3, -0.141421},
                                                 {1.7320508, -2.2360679, 2.4494897}}};
    std::vector<Point3> ends;
    for (const Vector3& d : directions) ends.push_back(moved(from, d, reach));
    return ends;
}

enum class Meeting { none, inside, edge, start };

/// Tells how the segment p q meets a triangle: not at all, inside it, on its border, or at p.
Meeting meet(const Point3& p, const Point3& q, const Point3& a, const Point3& b, const Point3& c) {
    const Sign at_p = orient3d(a, b, c, p);
    const Sign at_q = orient3d(a, b, c, q);
    if (at_p == at_q && at_p != Sign::Zero) return Meeting::none;
    const std::array<Sign, 3> around{orient3d(p, q, a, b), orient3d(p, q, b, c),
                                     orient3d(p, q, c, a)};
    const auto has = [&](Sign sign) {
        return std::find(around.begin(), around.end(), sign) != around.end();
    };
    if (has(Sign::Positive) && has(Sign::Negative)) return Meeting::none;
    if (has(Sign::Zero)) return Meeting::edge;
    if (at_p == Sign::Zero) return Meeting::start;
    return at_q == Sign::Zero ? Meeting::edge : Meeting::inside;
}

/// The point where a segment from p crosses a plane, at above / all of its length; all > 0.
struct Crossing {
    Exact above, all;
    std::uint32_t triangle = 0;

    friend bool operator<(const Crossing& a, const Crossing& b) {
        return exact_sign(a.above * b.all - b.above * a.all) == Sign::Negative;
    }
};

Crossing crossing(const Mesh& mesh, std::uint32_t t, const Point3& p, const Point3& q) {
    const auto at = [](const Point3& v) { return polynomial::cartesian<Exact>(v); };
    const auto& [i, j, k] = mesh.triangles[t];
    const auto a = at(mesh.vertices[i]), b = at(mesh.vertices[j]), c = at(mesh.vertices[k]);
    const Exact of_p = polynomial::orient3d(a, b, c, at(p));
    const Exact of_q = polynomial::orient3d(a, b, c, at(q));
    const bool front = exact_sign(of_p) == Sign::Positive;
    return front ? Crossing{of_p, of_p - of_q, t} : Crossing{-of_p, of_q - of_p, t};
}

enum class Walk { done, edge, on_triangle };

/// Finds the first triangle on the segment from p to q; returns the volume on its side towards p,
/// or 0, the outside, if there is none.
std::pair<Walk, std::uint32_t> walk(const Point3& p, const Point3& q, const Mesh& mesh,
                                    const Volumes& volumes) {
    std::optional<Crossing> nearest;
    const auto& v = mesh.vertices;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        switch (meet(p, q, v[a], v[b], v[c])) {
        case Meeting::none:
            break;
        case Meeting::edge:
            return {Walk::edge, 0};
        case Meeting::start:
            return {Walk::on_triangle, 0};
        case Meeting::inside:
            Crossing found = crossing(mesh, t, p, q);
            if (!nearest || found < *nearest) nearest = std::move(found);
        }
    }
    if (!nearest) return {Walk::done, 0};
    const auto& [a, b, c] = mesh.triangles[nearest->triangle];
    const bool front = orient3d(v[a], v[b], v[c], p) == Sign::Positive;
    return {Walk::done, volumes.of_sides[nearest->triangle][front ? 0 : 1]};
}

/// Returns the share of `direction` after which a ray meets the first triangle other than `self`,
/// in floating point.
double clear_share(const Mesh& mesh, std::uint32_t self, const Point3& from,
                   const Vector3& direction) {
    double least = HUGE_VAL;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (t == self) continue;
        const auto& [i, j, k] = mesh.triangles[t];
        const Point3& a = mesh.vertices[i];
        const Vector3 u = from_to(a, mesh.vertices[j]), w = from_to(a, mesh.vertices[k]);
        const Vector3 h = cross(direction, w), s = from_to(a, from), g = cross(s, u);
        const double det = dot(u, h);
        const double x = dot(s, h) / det, y = dot(direction, g) / det, share = dot(w, g) / det;
        if (x >= 0 && y >= 0 && x + y <= 1 && share > 0) least = std::min(least, share);
    }
    return least;
}

struct BlockSide {
    double area = 0;
    std::uint32_t triangle = 0;
    bool front = false; ///< whether the block is in front of the triangle
};

/// Returns the largest triangles of each volume, the largest first, at most most_triangles.
std::vector<std::vector<BlockSide>> largest_sides(const Mesh& mesh, const Volumes& volumes) {
    std::vector<std::vector<BlockSide>> sides(volumes.measures.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto& v = mesh.vertices;
        const Vector3 n = cross(from_to(v[a], v[b]), from_to(v[a], v[c]));
        const double area = std::hypot(n.x, n.y, n.z) / 2;
        if (volumes.dangles(t)) continue;
        sides[volumes.of_sides[t][0]].push_back({area, t, true});
        sides[volumes.of_sides[t][1]].push_back({area, t, false});
    }
    for (auto& list : sides) {
        const auto end =
            list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), most_triangles));
        std::partial_sort(list.begin(), end, list.end(),
                          [](const BlockSide& a, const BlockSide& b) {
                              return a.area != b.area ? a.area > b.area : a.triangle < b.triangle;
                          });
        list.erase(end, list.end());
    }
    return sides;
}

std::optional<Point3> point_near(const BlockSide& side, BlockId block, const Mesh& mesh,
                                 const Volumes& volumes) {
    const auto& [i, j, k] = mesh.triangles[side.triangle];
    const Point3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const Point3 middle{a.x / 3 + b.x / 3 + c.x / 3, a.y / 3 + b.y / 3 + c.y / 3,
                        a.z / 3 + b.z / 3 + c.z / 3};
    Vector3 inward = cross(from_to(a, b), from_to(a, c));
    if (!side.front) inward = {-inward.x, -inward.y, -inward.z};
    const double share = clear_share(mesh, side.triangle, middle, inward);
    for (const double part : {0.5, 0.3, 0.7}) {
        const Point3 place = moved(middle, inward, part * share);
        if (!is_finite(place)) continue;
        if (volume_around(place, mesh, volumes) == block) return place;
    }
    return std::nullopt;
}

} // namespace

std::optional<BlockId> volume_around(const Point3& place, const Mesh& mesh,
                                     const Volumes& volumes) {
    const StandardArithmetic guard;
    for (const Point3& end : ends_outside(mesh, place)) {
        const auto [how, volume] = walk(place, end, mesh, volumes);
        if (how == Walk::on_triangle) return std::nullopt;
        if (how == Walk::done) return BlockId(volume);
    }
    return std::nullopt;
}

Result<std::vector<BlockPoint>> block_points(const Mesh& mesh, const Volumes& volumes,
                                             const Run& run) {
    return guarded("for the points", "points", [&]() -> Result<std::vector<BlockPoint>> {
        const auto sides = largest_sides(mesh, volumes);
        std::vector<BlockPoint> points;
        for (std::uint32_t block = 1; block < sides.size(); ++block)
            for (const BlockSide& side : sides[block]) {
                if (run.stop.stop_requested())
                    return Error{ErrorCode::interrupted, "stopped on request", ""};
                const auto place = point_near(side, BlockId(block), mesh, volumes);
                if (!place) continue;
                points.push_back({*place, BlockId(block)});
                break;
            }
        return points;
    });
}

} // namespace terrane
