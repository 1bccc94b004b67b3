// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/quality.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>

namespace terrane {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
using Corners = std::array<Point3, 3>;

Point3 weighted(const Corners& t, double a, double b, double c) {
    return {a * t[0].x + b * t[1].x + c * t[2].x, a * t[0].y + b * t[1].y + c * t[2].y,
            a * t[0].z + b * t[1].z + c * t[2].z};
}

double apart(const Point3& a, const Point3& b) {
    return distance_between(a, b);
}

Corners corners_of(const Surface& s, const Triangle& t) {
    return {s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]};
}

/// Part of a triangle. No point of it is farther than `most` from the other surface.
struct Part {
    double most = 0;
    Corners corners;

    friend bool operator<(const Part& a, const Part& b) { return a.most < b.most; }
};

/// Bounds the distance of a part: the distance function is 1-Lipschitz, so no point is farther than
/// the centroid's distance plus the radius around it; and the distance from one triangle is
/// convex, so no point is farther from it than the farthest corner. Raises `least` to the distance
/// of the centroid.
Part part_of(const TriangleTree& tree, std::span<const Point3> points, const Corners& c,
             double& least) {
    const Point3 middle = weighted(c, 1.0 / 3, 1.0 / 3, 1.0 / 3);
    const double radius = std::max({apart(middle, c[0]), apart(middle, c[1]), apart(middle, c[2])});
    const auto near = tree.nearest(middle, endless);
    if (!near) return {endless, c};
    least = std::max(least, near->distance);
    const auto& [i, j, k] = near->triangle;
    double convex = 0;
    for (const Point3& p : c)
        convex = std::max(convex, distance_to_triangle(p, points[i], points[j], points[k]));
    return {std::min(near->distance + radius, convex), c};
}

std::array<Corners, 4> quarters(const Corners& c) {
    const Corners m{weighted(c, 0.5, 0.5, 0), weighted(c, 0, 0.5, 0.5), weighted(c, 0.5, 0, 0.5)};
    return {Corners{c[0], m[0], m[2]}, Corners{m[0], c[1], m[1]}, Corners{m[2], m[1], c[2]}, m};
}

} // namespace

double sampled_distance(const Surface& from, const Surface& to, const Run& run) {
    const StandardArithmetic guard;
    if (to.triangles.empty()) return from.triangles.empty() ? 0 : endless;
    const TriangleTree tree(to.vertices, to.triangles);
    constexpr std::array<std::array<double, 3>, 13> weights{{{1, 0, 0},
                                                             {0, 1, 0},
                                                             {0, 0, 1},
                                                             {0.5, 0.5, 0},
                                                             {0, 0.5, 0.5},
                                                             {0.5, 0, 0.5},
                                                             {1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                             {0.6, 0.2, 0.2},
                                                             {0.2, 0.6, 0.2},
                                                             {0.2, 0.2, 0.6},
                                                             {0.1, 0.45, 0.45},
                                                             {0.45, 0.1, 0.45},
                                                             {0.45, 0.45, 0.1}}};
    const auto parts = parts_of_ranges<double>(
        from.triangles.size(), run, [&](std::size_t first, std::size_t last) {
            double largest = 0;
            for (std::size_t t = first; t < last; ++t)
                for (const auto& w : weights) {
                    const Point3 p =
                        weighted(corners_of(from, from.triangles[t]), w[0], w[1], w[2]);
                    largest = std::max(largest, tree.distance(p, endless));
                }
            return largest;
        });
    return parts.empty() ? 0 : *std::max_element(parts.begin(), parts.end());
}

double distance_bound(const Surface& from, const Surface& to, double tolerance, const Run& run) {
    const StandardArithmetic guard;
    if (to.triangles.empty()) return from.triangles.empty() ? 0 : endless;
    const TriangleTree tree(to.vertices, to.triangles);
    std::priority_queue<Part> front;
    double least = 0;
    for (const Triangle& t : from.triangles)
        front.push(part_of(tree, to.vertices, corners_of(from, t), least));
    while (!front.empty() && front.top().most > least + tolerance && !run.stop.stop_requested()) {
        const Corners c = front.top().corners;
        front.pop();
        for (const Corners& quarter : quarters(c)) {
            const Part part = part_of(tree, to.vertices, quarter, least);
            if (part.most > least + tolerance) front.push(part);
        }
    }
    // Every part that was dropped had a smaller bound.
    return std::max(least + tolerance, front.empty() ? 0 : front.top().most);
}

std::vector<Deviation> deviations_of(const Mesh& before, const Mesh& after, const Run& run) {
    const StandardArithmetic guard;
    std::vector<Deviation> all;
    const std::size_t count =
        std::max(before.triangles.size() + after.triangles.size(), std::size_t{1});
    std::size_t done = 0; // triangles; of those in several surfaces, as often
    const auto measured = [&](const Surface& from, const Surface& to) {
        const auto share = [&] { return double(std::min(done, count)) / double(count); };
        const double start = share();
        done += from.triangles.size();
        return measured_distance(from, to, part_of_stage(run, "measure", start, share()));
    };
    for (std::uint32_t s = 0; s < before.surfaces.size(); ++s) {
        if (run.stop.stop_requested()) break;
        const Surface old = surface_of_mesh(before, s), now = surface_of_mesh(after, s);
        const double out = measured(now, old);
        all.push_back({out, measured(old, now)});
    }
    return all;
}

} // namespace terrane
