// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/detail/fault_slip.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::uncertainty::detail {
namespace {

/// The triangles of a fault, and the range of its strike.
struct Fault {
    std::vector<Point3> points{};
    std::vector<Triangle> triangles{};
    double first = HUGE_VAL, last = -HUGE_VAL; ///< along the strike

    Fault(std::span<const Surface> all, std::span<const std::uint32_t> surfaces,
          const FaultPlane& plane) {
        for (const std::uint32_t s : surfaces) {
            const auto start = static_cast<std::uint32_t>(points.size());
            points.insert(points.end(), all[s].vertices.begin(), all[s].vertices.end());
            for (const Triangle& t : all[s].triangles)
                triangles.push_back({t[0] + start, t[1] + start, t[2] + start});
        }
        for (const Point3& p : points) {
            const double at = dot(minus(p, plane.centre), plane.strike);
            first = std::min(first, at);
            last = std::max(last, at);
        }
    }
};

} // namespace

SlipShares slip_shares(std::span<const Surface> all, std::span<const std::uint32_t> fault,
                       const FaultPlane& plane, std::optional<double> reach, SurfaceId horizon) {
    const Fault of(all, fault, plane);
    const Surface& surface = all[horizon];
    SlipShares result{horizon, std::vector<double>(surface.vertices.size())};
    if (of.triangles.empty()) return result;
    const TriangleTree tree(of.points, of.triangles);
    const double on_it = 1e-9 * (of.last - of.first); // rounding of places on the fault
    const std::size_t n = surface.vertices.size();
    std::vector<double> side(n), distance(n, HUGE_VAL), near_side(n);
    for (std::size_t v = 0; v < n; ++v) {
        const Point3& p = surface.vertices[v];
        const double at = dot(minus(p, plane.centre), plane.strike);
        if (at < of.first - on_it || at > of.last + on_it) continue;
        const auto near = tree.nearest(p, HUGE_VAL);
        if (!near) continue;
        distance[v] = near->distance;
        side[v] = dot(minus(p, near->place), plane.normal);
    }
    for (const Triangle& t : surface.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            near_side[t[i]] += side[t[(i + 1) % 3]] + side[t[(i + 2) % 3]];
    for (std::size_t v = 0; v < n; ++v) {
        const double which = distance[v] <= on_it ? near_side[v] : side[v];
        if (!(which > 0) || distance[v] == HUGE_VAL) continue;
        result.shares[v] = reach ? std::max(0.0, 1 - distance[v] / *reach) : 1;
    }
    return result;
}

} // namespace terrane::uncertainty::detail
