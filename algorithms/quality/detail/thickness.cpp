// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/thickness.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::quality::detail {
namespace {

using Corners3 = std::array<Point3, 3>;

/// Returns the distance along the unit vector n, in either direction, at which the line through p
/// meets the triangle, if it does.
std::optional<double> distance_along(const Point3& p, const Point3& n, const Corners3& t) {
    const Point3 ab = minus(t[1], t[0]), ac = minus(t[2], t[0]), h = cross(n, ac);
    const double size = dot(ab, h);
    if (size == 0) return std::nullopt;
    const Point3 d = minus(p, t[0]), k = cross(d, ab);
    const double u = dot(d, h) / size, v = dot(n, k) / size;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) return std::nullopt;
    return std::fabs(dot(ac, k) / size);
}

Corners3 corners_in(std::span<const Point3> points, const Triangle& t) {
    return {points[t[0]], points[t[1]], points[t[2]]};
}

/// Returns the box of all points within `far` of the triangle along its unit normal.
Box prism_of(const Corners3& c, const Point3& n, double far) {
    Box box{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    const std::array<double, 3> reach{std::fabs(n.x) * far, std::fabs(n.y) * far,
                                      std::fabs(n.z) * far};
    for (const Point3& p : c) {
        const std::array<double, 3> at{p.x, p.y, p.z};
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], at[k] - reach[k]);
            box.high[k] = std::max(box.high[k], at[k] + reach[k]);
        }
    }
    return box;
}

/// Returns the least distance from the centroid and from three points near the corners.
double least_distance(const Corners3& c, const Point3& n, const Corners3& other) {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<double, 3> w{1.0 / 3, 1.0 / 3, 1.0 / 3};
        if (i < 3) {
            w = {0.15, 0.15, 0.15};
            w[i] = 0.7;
        }
        const Point3 p{w[0] * c[0].x + w[1] * c[1].x + w[2] * c[2].x,
                       w[0] * c[0].y + w[1] * c[1].y + w[2] * c[2].y,
                       w[0] * c[0].z + w[1] * c[1].z + w[2] * c[2].z};
        if (const auto d = distance_along(p, n, other)) least = std::min(least, *d);
    }
    return least;
}

/// Finds the largest bound of the triangles of a sheet around one of them.
class Spreader {
public:
    Spreader(const Mesh& mesh, const Features& features, const Sizes& sizes) :
        mesh_(mesh), features_(features), sizes_(sizes), seen_(features.triangles.size(), none) {}

    /// Looks at triangles with a corner within the wanted length of the centroid of t.
    double operator()(std::uint32_t t, std::span<const double> bounds) {
        const Triangle& corners = features_.triangles[t];
        const Corners3 c = corners_in(mesh_.vertices, corners);
        const Point3 middle{(c[0].x + c[1].x + c[2].x) / 3, (c[0].y + c[1].y + c[2].y) / 3,
                            (c[0].z + c[1].z + c[2].z) / 3};
        double reach = HUGE_VAL;
        for (const std::uint32_t v : corners)
            reach = std::min(reach, constants.thin_reach * sizes_.of_vertices[v]);
        near_.assign(1, t);
        seen_[t] = t;
        double largest = bounds[t];
        for (std::size_t k = 0; k < near_.size() && k < constants.thin_triangles; ++k) {
            largest = std::max(largest, bounds[near_[k]]);
            const Triangle& here = features_.triangles[near_[k]];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t next = features_.across[near_[k]][i];
                if (next == none || seen_[next] == t) continue;
                const auto away = [&](std::uint32_t v) {
                    return length(minus(mesh_.vertices[v], middle));
                };
                if (std::min(away(here[i]), away(here[(i + 1) % 3])) > reach) continue;
                seen_[next] = t;
                near_.push_back(next);
            }
        }
        return largest;
    }

private:
    const Mesh& mesh_;
    const Features& features_;
    const Sizes& sizes_;
    std::vector<std::uint32_t> seen_; ///< per triangle: that around which it was seen last
    std::vector<std::uint32_t> near_;
};

} // namespace

std::vector<double> thickness_of(std::span<const Point3> points,
                                 std::span<const Triangle> triangles,
                                 std::span<const double> reach_of, const Run& run) {
    const auto count = static_cast<std::uint32_t>(triangles.size());
    std::vector<double> thickness(count, std::numeric_limits<double>::infinity());
    std::vector<Point3> normals(count);
    std::vector<Box> boxes(2 * static_cast<std::size_t>(count)); // prisms, then triangles
    std::vector<std::uint32_t> groups(boxes.size(), 0), prisms(count);
    std::iota(prisms.begin(), prisms.end(), 0U);
    for (std::uint32_t t = 0; t < count; ++t) {
        const Corners3 c = corners_in(points, triangles[t]);
        const Point3 n = cross(minus(c[1], c[0]), minus(c[2], c[0]));
        const double size = length(n);
        normals[t] = size > 0 ? Point3{n.x / size, n.y / size, n.z / size} : Point3{};
        boxes[t] = prism_of(c, normals[t], reach_of[t]);
        boxes[count + t] = box_of(points, triangles[t]);
        groups[count + t] = 1;
    }
    Run one = without_progress(run); // the results are not synchronised
    one.threads = 1;
    candidate_pairs_of(
        boxes, prisms, groups,
        [&](const CandidatePair& p) {
            const std::uint32_t t = p.first, other = p.second - count;
            if (!(std::fabs(dot(normals[t], normals[other])) >= constants.thin_cosine))
                return false;
            if (t == other) return false;
            const double far = least_distance(corners_in(points, triangles[t]), normals[t],
                                              corners_in(points, triangles[other]));
            if (far > 0 && far <= reach_of[t]) thickness[t] = std::min(thickness[t], far);
            return false; // pairs need not be kept
        },
        one);
    return thickness;
}

std::vector<double> bounds_by_thickness(const Mesh& mesh, const Features& features,
                                        const Sizes& sizes, double share, const Run& run) {
    std::vector<double> bounds, reach_of;
    for (const std::uint32_t sheet : features.sheet_of) {
        bounds.push_back(sizes.bound_of[sheet]);
        reach_of.push_back(bounds.back() / share);
    }
    const auto thickness = thickness_of(mesh.vertices, features.triangles, reach_of, run);
    bool is_limited = false;
    for (std::size_t t = 0; t < bounds.size(); ++t) {
        if (!(share * thickness[t] < bounds[t])) continue;
        bounds[t] = share * thickness[t];
        is_limited = true;
    }
    if (!is_limited) return {};
    std::vector<double> spread = bounds;
    Spreader spreader(mesh, features, sizes);
    for (std::uint32_t t = 0; t < bounds.size(); ++t)
        if (bounds[t] < sizes.bound_of[features.sheet_of[t]]) spread[t] = spreader(t, bounds);
    return spread;
}

} // namespace terrane::quality::detail
