// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/bounds_back.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stop_token>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/quality/detail/reference_surface.hpp>
#include <terrane/algorithms/quality/quality.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t told_every = 1024; ///< triangles between two reports of progress

using namespace quality::detail;

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Arranges the improved mesh by the sheets of the original, as the reference surface to compare
/// with.
Features features_of(const Features& before, const Improved& after, const Run& run) {
    Features now;
    now.triangles = after.mesh->triangles;
    for (const std::uint32_t t : after.near_of) now.sheet_of.push_back(before.sheet_of[t]);
    now.across.assign(now.triangles.size(), {none, none, none});
    const auto side_of = [&](std::uint32_t t, std::uint32_t from, std::uint32_t to) {
        const Triangle& c = now.triangles[t];
        for (std::size_t i = 0; i < 3; ++i)
            if (c[i] == from && c[(i + 1) % 3] == to) return i;
        return std::size_t{3};
    };
    const EdgeSides edges = group_edges(now.triangles, after.mesh->vertices.size(), run);
    edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        if (sides.size() != 2) return;
        const std::uint32_t t = sides[0].triangle, u = sides[1].triangle;
        if (now.sheet_of[t] != now.sheet_of[u]) return;
        const bool forward = runs_along(now.triangles[t], low, high);
        const std::size_t i = forward ? side_of(t, low, high) : side_of(t, high, low);
        const std::size_t j = forward ? side_of(u, high, low) : side_of(u, low, high);
        if (j == 3) return; // orientations differ
        now.across[t][i] = u;
        now.across[u][j] = t;
    });
    return now;
}

/// Finds, for each original triangle, an improved one near it in its sheet; none if the sheet has
/// none.
std::vector<std::uint32_t> hints_of(const Features& before, const Improved& after) {
    std::vector<std::uint32_t> hints(before.triangles.size(), none), front;
    for (std::uint32_t t = 0; t < after.near_of.size(); ++t) {
        std::uint32_t& hint = hints[after.near_of[t]];
        if (hint != none) continue;
        hint = t;
        front.push_back(after.near_of[t]);
    }
    for (std::size_t k = 0; k < front.size(); ++k)
        for (const std::uint32_t u : before.across[front[k]]) {
            if (u == none || hints[u] != none) continue;
            hints[u] = hints[front[k]];
            front.push_back(u);
        }
    return hints;
}

/// Computes, for each sheet, the least bound of its surfaces.
std::vector<double> bounds_of_sheets(const Mesh& before, const Features& features,
                                     const ImproveReport& report) {
    std::vector<double> bounds;
    for (const std::uint32_t first : features.first_of) {
        double least = unbounded;
        for (const std::uint32_t s : before.surfaces_of[first])
            least = std::min(least, report.bound_of[s]);
        bounds.push_back(least);
    }
    return bounds;
}

/// Proves distances of parts that have no covering: parts across a curve that has moved, or too
/// thin to be projected. A part is within the bound if all its corners are within the bound of one
/// triangle (the distance to a convex set is a convex function), or if the distance of its centroid
/// plus the radius around it is (the distance is 1-Lipschitz).
class Nearest {
public:
    Nearest(const Mesh& after, std::uint32_t surface, std::stop_token stop) :
        surface_(surface_of_mesh(after, surface)),
        tree_(surface_.vertices, without_slivers(surface_)), stop_(std::move(stop)) {}

    /// Tells whether the whole triangle is within the bound. A part that is large against the bound
    /// also passes if contains_within_tolerance(part) holds. False if a stop was requested.
    template <class Follows>
    [[nodiscard]] bool is_near(const Corners& whole, double bound,
                               const Follows& contains_within_tolerance) const {
        std::vector<Corners> parts{whole};
        for (unsigned count = 0; !parts.empty(); ++count) {
            if (count % 64 == 63 && stop_.stop_requested()) return false;
            const Corners c = parts.back();
            parts.pop_back();
            const Point3 middle{(c[0].x + c[1].x + c[2].x) / 3, (c[0].y + c[1].y + c[2].y) / 3,
                                (c[0].z + c[1].z + c[2].z) / 3};
            const auto near = tree_.nearest(middle, unbounded);
            if (!near) return false;
            const auto off = [&](const Point3& p) {
                const auto& [i, j, k] = near->triangle;
                return to_triangle(p, surface_.vertices[i], surface_.vertices[j],
                                   surface_.vertices[k]);
            };
            if (std::max({off(c[0]), off(c[1]), off(c[2])}) <= bound) continue;
            const double there = off(middle);
            const double radius =
                std::max({apart(middle, c[0]), apart(middle, c[1]), apart(middle, c[2])});
            if (there + radius <= bound) continue;
            if (there > bound || count == constants.most_parts_back) return false;
            if (radius > constants.coarse_part_back * bound && contains_within_tolerance(c))
                continue;
            divide(c, parts);
        }
        return true;
    }

private:
    /// Omits triangles so thin that rounding would decide which of their points is nearest. The
    /// remaining part of the surface is never nearer than the whole.
    static std::vector<Triangle> without_slivers(const Surface& surface) {
        std::vector<Triangle> kept;
        for (const Triangle& t : surface.triangles) {
            const Point3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]],
                         &c = surface.vertices[t[2]];
            const Point3 n = cross(minus(b, a), minus(c, a));
            const double longest = std::max({apart(a, b), apart(b, c), apart(c, a)});
            if (std::sqrt(dot(n, n)) > constants.thinnest * longest * longest) kept.push_back(t);
        }
        return kept;
    }
    static double apart(const Point3& a, const Point3& b) {
        const Point3 d = minus(b, a);
        return std::sqrt(dot(d, d));
    }
    /// Bisects the longest edge.
    static void divide(const Corners& c, std::vector<Corners>& parts) {
        std::size_t i = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (apart(c[k], c[(k + 1) % 3]) > apart(c[i], c[(i + 1) % 3])) i = k;
        const Point3 &a = c[i], &b = c[(i + 1) % 3], &d = c[(i + 2) % 3];
        const Point3 m{a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2, a.z + (b.z - a.z) / 2};
        parts.push_back({a, m, d});
        parts.push_back({m, b, d});
    }

    Surface surface_;
    TriangleTree tree_;
    std::stop_token stop_;
};

Result<std::vector<double>> shown(const Mesh& before, const Improved& after,
                                  const ImproveOptions& options, const Run& run) {
    const double radians = std::acos(-1.0) / 180;
    const Error interrupted{ErrorCode::interrupted, "stopped on request", ""};
    const Features features =
        find_features(before, {options.crease_angle * radians, options.curve_angle * radians}, run);
    if (run.stop.stop_requested()) return interrupted;
    const Features now = features_of(features, after, run);
    if (run.stop.stop_requested()) return interrupted;
    const auto hints = hints_of(features, after);
    std::vector<double> bounds = bounds_of_sheets(before, features, after.report);
    const ReferenceSurface reference(after.mesh->vertices, now, bounds);
    ReferenceSurface::Search search;
    std::vector<double> of_surfaces(before.surfaces.size(), 0);
    std::vector<std::uint32_t> open(features.triangles.size());
    for (std::uint32_t t = 0; t < open.size(); ++t) open[t] = t;
    const auto raise = [&](std::uint32_t t, double bound) {
        for (const std::uint32_t s : before.surfaces_of[t])
            of_surfaces[s] = std::max(of_surfaces[s], bound);
    };
    std::vector<std::optional<Nearest>> nearest(before.surfaces.size());
    const auto is_near = [&](std::uint32_t t, const Corners& corners) {
        const double bound = bounds[features.sheet_of[t]] - reference.rounding();
        const auto surfaces = before.surfaces_of[t];
        return std::all_of(surfaces.begin(), surfaces.end(), [&](std::uint32_t s) {
            if (!nearest[s]) nearest[s].emplace(after.mesh, s, run.stop);
            return nearest[s]->is_near(corners, bound, [&](const Corners& part) {
                return hints[t] != none &&
                       reference.contains_within_tolerance(part, hints[t], search).has_value();
            });
        });
    };
    for (double factor = 1; factor <= constants.most_factor_back && !open.empty(); factor *= 2) {
        std::vector<std::uint32_t> still_open;
        for (const std::uint32_t t : open) {
            if (run.stop.stop_requested()) return interrupted;
            if (factor == 1 && t % told_every == 0) // most are near enough the first time
                report_part(run, "measure", 0, 1, t, features.triangles.size());
            const auto& [a, b, c] = features.triangles[t];
            const Corners corners{before.vertices[a], before.vertices[b], before.vertices[c]};
            if ((hints[t] != none &&
                 reference.contains_within_tolerance(corners, hints[t], search)) ||
                is_near(t, corners))
                raise(t, bounds[features.sheet_of[t]]);
            else
                still_open.push_back(t);
        }
        open = std::move(still_open);
        for (double& bound : bounds) bound *= 2;
    }
    for (const std::uint32_t t : open) raise(t, unbounded);
    if (run.stop.stop_requested()) return interrupted;
    return of_surfaces;
}

} // namespace

Result<std::vector<double>> bounds_back(const Mesh& before, const Improved& after,
                                        const ImproveOptions& options, const Run& run) {
    return guarded("to measure the mesh", "improve",
                   [&] { return shown(before, after, options, run); });
}

} // namespace terrane
