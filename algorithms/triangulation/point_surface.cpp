// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/triangulation/point_surface.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/triangulation/detail/constants.hpp>
#include <terrane/algorithms/triangulation/planar.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

using triangulation::detail::constants;

/// Returns two axes in the plane of least squares and its normal, as rows.
Eigen::Matrix3d best_axes(std::span<const Point3> points, const Eigen::Vector3d& centre,
                          double scale) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Point3& p : points) {
        const Eigen::Vector3d d = (Eigen::Vector3d(p.x, p.y, p.z) - centre) / scale;
        spread += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    Eigen::Matrix3d axes;
    axes.row(0) = solver.eigenvectors().col(2);
    axes.row(1) = solver.eigenvectors().col(1);
    axes.row(2) = axes.row(0).cross(axes.row(1));
    return axes;
}

/// Projects the points along the normal of the plane of least squares. Returns nothing if they are at
/// one place, or, where only `tilted` planes are wanted, if the normal is within 45 degrees of z.
std::vector<Point3> flattened(std::span<const Point3> points, bool tilted) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double scale = 0;
    for (const Point3& p : points)
        centre += Eigen::Vector3d(p.x, p.y, p.z) / static_cast<double>(points.size());
    for (const Point3& p : points)
        scale =
            std::max(scale, (Eigen::Vector3d(p.x, p.y, p.z) - centre).lpNorm<Eigen::Infinity>());
    if (!(scale > 0) || !std::isfinite(scale)) return {};
    const Eigen::Matrix3d axes = best_axes(points, centre, scale);
    if (tilted && std::abs(axes(2, 2)) >= std::sqrt(constants.upright)) return {};
    std::vector<Point3> flat;
    for (const Point3& p : points) {
        const Eigen::Vector3d q = axes * (Eigen::Vector3d(p.x, p.y, p.z) - centre);
        flat.push_back({q.x(), q.y(), 0});
    }
    return flat;
}

double longest_edge(std::span<const Point3> points, const Triangle& t) {
    double longest = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const Point3 &a = points[t[i]], &b = points[t[(i + 1) % 3]];
        longest = std::max(longest, std::hypot(a.x - b.x, a.y - b.y));
    }
    return longest;
}

/// Returns the median edge length, where edges between two triangles count twice; 0 without edges.
double median_edge(std::span<const Point3> points, std::span<const Triangle> triangles,
                   bool in_plane) {
    std::vector<double> lengths;
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const Point3 &a = points[t[i]], &b = points[t[(i + 1) % 3]];
            lengths.push_back(std::hypot(a.x - b.x, a.y - b.y, in_plane ? 0 : a.z - b.z));
        }
    if (lengths.empty()) return 0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

} // namespace

Result<std::vector<Triangle>> connect_points(std::span<const Point3> points,
                                             const ConnectOptions& options, const Run& run) {
    return guarded("to connect points", "points", [&]() -> Result<std::vector<Triangle>> {
        if (!(options.max_edge >= 0))
            return Error{ErrorCode::bad_option, "the longest edge must be a length", ""};
        if (points.size() < 3) return std::vector<Triangle>{};
        std::vector<Point3> flat(points.begin(), points.end());
        auto triangles = delaunay(flat, run);
        if (!triangles) return triangles;
        if (auto tilted = flattened(points, true); !tilted.empty()) {
            auto others = delaunay(tilted, run);
            if (!others) return others;
            const double upright = median_edge(points, triangles.value(), false);
            const double along = median_edge(points, others.value(), false);
            if (upright == 0 || along < constants.worth_tilting * upright) {
                flat = std::move(tilted);
                triangles = std::move(others);
            }
        }
        const double limit = options.max_edge > 0 ? options.max_edge
                                                  : constants.longest_edge *
                                                        median_edge(flat, triangles.value(), true);
        std::erase_if(triangles.value(), [&](const Triangle& t) {
            return longest_edge(flat, t) > limit ||
                   collinear(points[t[0]], points[t[1]], points[t[2]]);
        });
        return triangles;
    });
}

Result<std::vector<Triangle>> fill_closed_line(std::span<const Point3> line, const Run& run) {
    return guarded("to fill the line", "line", [&]() -> Result<std::vector<Triangle>> {
        const auto flat = flattened(line, false);
        if (flat.size() < 3) return std::vector<Triangle>{};
        Polygon polygon(flat.size());
        std::iota(polygon.begin(), polygon.end(), 0U);
        auto triangles = triangulate_inside(flat, std::span(&polygon, 1), run);
        if (triangles || triangles.error().code != ErrorCode::improper_contact) return triangles;
        return Error{
            ErrorCode::improper_contact,
            "the line touches or crosses itself, seen along the normal of its plane of least "
            "squares",
            ""};
    });
}

std::vector<NamedConstant> point_constants() {
    return triangulation::detail::constants.listed();
}

} // namespace terrane
