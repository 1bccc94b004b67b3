// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/sliding_vertices.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/quality/detail/reference_surface.hpp>
#include <terrane/algorithms/quality/detail/sizes.hpp>
#include <terrane/algorithms/quality/detail/thickness.hpp>

namespace terrane {

using quality::detail::Corners;
using quality::detail::Features;
using quality::detail::ReferenceSurface;

/// The surfaces before, with bounds.
struct SlidingVertices::Reference {
    Reference(const Mesh& before, const ImproveReport& report, const ImproveOptions& options,
              const Run& run) :
        features(quality::detail::find_features(
            before, {radians(options.crease_angle), radians(options.curve_angle)}, run)),
        bounds(bounds_of_sheets(before, report)), surface(before.vertices, features, bounds) {
        surface.limit_bounds(quality::detail::bounds_by_thickness(
            before, features, quality::detail::find_sizes(before, features, options),
            options.thickness_share, run));
    }

    static double radians(double degrees) { return degrees * std::acos(-1.0) / 180; }

    [[nodiscard]] std::vector<double> bounds_of_sheets(const Mesh& before,
                                                       const ImproveReport& report) const {
        std::vector<double> least(features.first_of.size(),
                                  std::numeric_limits<double>::infinity());
        for (std::size_t sheet = 0; sheet < least.size(); ++sheet)
            for (const std::uint32_t s : before.surfaces_of[features.first_of[sheet]])
                least[sheet] = std::min(least[sheet], report.bound_of[s]);
        return least;
    }

    const Features features;
    const std::vector<double> bounds; ///< per sheet
    ReferenceSurface surface;
};

SlidingVertices::SlidingVertices(const Mesh& before, const Improved& after,
                                 const ImproveOptions& options, const Run& run) :
    mesh_(after.mesh),
    after_(after),
    reference_(std::make_unique<const Reference>(before, after.report, options, run)),
    triangle_at_(mesh_.vertices.size(), UINT32_MAX) {
    const auto& sheet_of = reference_->features.sheet_of;
    std::vector<bool> is_on_curve(mesh_.vertices.size());
    group_edges(mesh_.triangles, mesh_.vertices.size(), run)
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (sides.size() == 2 && sheet_of[after.near_of[sides[0].triangle]] ==
                                         sheet_of[after.near_of[sides[1].triangle]])
                return;
            is_on_curve[low] = is_on_curve[high] = true;
        });
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        for (const std::uint32_t v : mesh_.triangles[t])
            if (!is_on_curve[v]) triangle_at_[v] = t;
}

SlidingVertices::~SlidingVertices() = default;

std::optional<Point3> SlidingVertices::place(std::uint32_t v, const Point3& p) const {
    const std::uint32_t t = triangle_at_[v];
    const Triangle& c = mesh_.triangles[t];
    const Point3 normal = cross(minus(mesh_.vertices[c[1]], mesh_.vertices[c[0]]),
                                minus(mesh_.vertices[c[2]], mesh_.vertices[c[0]]));
    const auto found = reference_->surface.above(p, normal, after_.near_of[t]);
    if (!found) return std::nullopt;
    return found->point;
}

std::vector<std::uint32_t> SlidingVertices::not_shown(std::span<const Point3> points) const {
    std::vector<std::uint32_t> open;
    ReferenceSurface::Search search;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh_.triangles[t];
        const Corners corners{points[a], points[b], points[c]};
        if (corners == Corners{mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]}) continue;
        if (!reference_->surface.contains_within_tolerance(corners, after_.near_of[t], search))
            open.push_back(t);
    }
    return open;
}

} // namespace terrane
