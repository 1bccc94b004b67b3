// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tolerance/detail/fences.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/surface_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/tolerance/detail/creases.hpp>
#include <terrane/algorithms/tolerance/detail/tuning.hpp>

namespace terrane::tolerance::detail {
namespace {

double spacing_at(const Point3& p) {
    const double largest = std::max(
        {std::fabs(p.x), std::fabs(p.y), std::fabs(p.z), std::numeric_limits<double>::min()});
    return std::ldexp(1.0, std::ilogb(largest) - 52);
}

/// Returns the distance of the farthest of the other surfaces that are within the bound; 0 if none is.
double farthest_of_near(const SurfaceTree& tree, std::uint32_t surface, const Point3& p,
                        double bound) {
    std::vector<std::uint32_t> seen{surface};
    double farthest = 0;
    while (const auto near = tree.nearest(p, seen, bound)) {
        farthest = std::max(farthest, near->distance);
        seen.insert(std::ranges::upper_bound(seen, near->surface), near->surface);
    }
    return farthest;
}

/// The fences of one surface.
class Fences {
public:
    Fences(const Surface& surface, std::uint32_t number, const SurfaceTree& tree,
           double tolerance) :
        s_(surface),
        number_(number), tree_(tree), tolerance_(tolerance), edges_(edges_of(surface)),
        sectors_(3 * surface.triangles.size()), normals_(3 * surface.triangles.size()) {
        for (const SurfaceEdge& e : edges_)
            if (!e.is_crease) join_corners(e);
        for (std::uint32_t c = 0; c < normals_.size(); ++c) {
            const Point3 n = normal_of(s_, c / 3);
            Point3& sum = normals_[sectors_.find(c)];
            sum = along(sum, dot(sum, n) < 0 ? -1 : 1, n);
        }
    }

    void append_to(Surface& out) {
        for (const SurfaceEdge& e : edges_) {
            if (!e.is_crease) continue;
            const double a = reach(e.ends[0]), b = reach(e.ends[1]);
            const double most = std::max({a, b, reach(middle_of(e.ends[0], e.ends[1]))});
            if (most == 0) continue;
            for (const auto& side : e.sides)
                append(e, side, a != 0 ? a : most, b != 0 ? b : most, out);
        }
    }

private:
    /// Returns the corner of a side's triangle at the lesser end, or the other, of the edge.
    static std::uint32_t corner(const SurfaceEdge::Side& side, bool lesser) {
        return 3 * side.triangle + (lesser == side.forward ? side.corner : (side.corner + 1) % 3);
    }
    void join_corners(const SurfaceEdge& e) {
        for (const bool lesser : {true, false})
            sectors_.join(corner(e.sides[0], lesser), corner(e.sides[1], lesser));
    }
    /// Returns how far fences go at a vertex; 0 if no other surface is near, or all pass through it.
    double reach(const Point3& p) {
        const auto [at, is_new] = reach_.emplace(p, 0.0);
        if (!is_new) return at->second;
        const double farthest = farthest_of_near(tree_, number_, p, tolerance_);
        if (farthest > 0)
            at->second = std::min(tolerance_, tuning.fence_reach * farthest +
                                                  tuning.fence_spacings * spacing_at(p));
        return at->second;
    }
    void append(const SurfaceEdge& e, const SurfaceEdge::Side& side, double a, double b,
                Surface& out) {
        const Point3 n = unit(normals_[sectors_.find(corner(side, true))]);
        Point3 m = unit(normals_[sectors_.find(corner(side, false))]);
        if (dot(n, m) < 0) m = along({}, -1, m);
        for (const double sign : {1.0, -1.0}) {
            const auto first = static_cast<std::uint32_t>(out.vertices.size());
            out.vertices.insert(out.vertices.end(),
                                {e.ends[0], e.ends[1], along(e.ends[1], sign * b, m),
                                 along(e.ends[0], sign * a, n)});
            out.triangles.push_back({first, first + 1, first + 2});
            out.triangles.push_back({first, first + 2, first + 3});
        }
    }

    const Surface& s_;
    const std::uint32_t number_;
    const SurfaceTree& tree_;
    const double tolerance_;
    const std::vector<SurfaceEdge> edges_;
    DisjointSets
        sectors_; ///< corners of triangles (3 t + k) that no crease separates at their vertex
    std::vector<Point3> normals_; ///< per sector: the sum over its corners
    std::map<Point3, double> reach_;
};

/// The triangles of all surfaces.
struct Together {
    explicit Together(const std::vector<Surface>& surfaces) {
        for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
            const auto first = static_cast<std::uint32_t>(points.size());
            points.insert(points.end(), surfaces[s].vertices.begin(), surfaces[s].vertices.end());
            for (const Triangle& t : surfaces[s].triangles) {
                triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
                surface_of.push_back(std::span(&s, 1));
            }
        }
    }
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    IndexLists<std::uint32_t> surface_of;
};

} // namespace

void snap_near_vertices(std::vector<Surface>& surfaces, double bound) {
    const Together all(surfaces);
    if (all.triangles.empty()) return;
    const SurfaceTree tree({all.points, all.triangles, all.surface_of});
    const double step = std::ldexp(1.0, std::ilogb(bound / tuning.grid_steps));
    const auto snapped = [&](double x) { return std::nearbyint(x / step) * step; };
    for (std::uint32_t s = 0; s < surfaces.size(); ++s)
        for (Point3& p : surfaces[s].vertices)
            if (farthest_of_near(tree, s, p, bound) > 0)
                p = {snapped(p.x), snapped(p.y), snapped(p.z)};
}

std::map<Point3, Point3> near_vertices(std::span<const Point3> points,
                                       std::span<const Triangle> triangles, double bound) {
    DisjointSets clusters(points.size());
    std::set<std::uint32_t> ends;
    for (const Triangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = t[k], b = t[(k + 1) % 3];
            if (distance_between(points[a], points[b]) >= bound / tuning.grid_steps) continue;
            clusters.join(a, b);
            ends.insert({a, b});
        }
    std::map<Point3, Point3> joined;
    for (const auto v : ends) joined.emplace(points[v], points[clusters.find(v)]);
    return joined;
}

void join_near_vertices(std::vector<Surface>& surfaces, const std::map<Point3, Point3>& joined) {
    for (Surface& s : surfaces) {
        for (Point3& p : s.vertices)
            if (const auto at = joined.find(p); at != joined.end()) p = at->second;
    }
}

Surface fences_of(const std::vector<Surface>& surfaces, double tolerance) {
    const Together all(surfaces);
    Surface out;
    if (all.triangles.empty()) return out;
    const SurfaceTree tree({all.points, all.triangles, all.surface_of});
    for (std::uint32_t s = 0; s < surfaces.size(); ++s)
        Fences(surfaces[s], s, tree, tolerance).append_to(out);
    return out;
}

} // namespace terrane::tolerance::detail
