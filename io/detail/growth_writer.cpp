// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/detail/growth_writer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace terrane::detail {

namespace {

/// Bounds distances of triangles from a surface. The distance from one triangle is convex, so no
/// point of a part of a triangle is farther from it than the part's farthest corner.
class DistanceBound {
public:
    explicit DistanceBound(const Surface& to) : to_(to) {}

    /// Returns a bound that exceeds the largest distance by a sixteenth at most; infinity, if there
    /// are no triangles to be near.
    double operator()(const Surface& from, const Run& run) {
        constexpr double slack = 1.0 / 32;
        if (from.triangles.empty()) return 0;
        if (to_.triangles.empty()) return std::numeric_limits<double>::infinity();
        tree_.emplace(to_.vertices, to_.triangles);
        double largest = 0; // coordinate
        std::priority_queue<Part> parts;
        for (const auto& [a, b, c] : from.triangles) {
            const Corners corners{from.vertices[a], from.vertices[b], from.vertices[c]};
            for (const Point3& p : corners)
                largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
            parts.push(part_of(corners));
        }
        const auto enough = [&] { return (1 + slack) * least_ + std::ldexp(largest, -30); };
        while (parts.top().most > enough() && !run.stop.stop_requested()) {
            const Corners c = parts.top().corners;
            parts.pop();
            const Corners m{middle(c[0], c[1]), middle(c[1], c[2]), middle(c[2], c[0])};
            for (const Corners& quarter : {Corners{c[0], m[0], m[2]}, Corners{m[0], c[1], m[1]},
                                           Corners{m[2], m[1], c[2]}, m})
                parts.push(part_of(quarter));
        }
        return (1 + slack / 2) * std::max(enough(), parts.top().most);
    }

private:
    using Corners = std::array<Point3, 3>;
    struct Part {
        double most = 0; ///< no point of it is farther
        Corners corners{};
        friend bool operator<(const Part& a, const Part& b) { return a.most < b.most; }
    };

    static Point3 middle(const Point3& a, const Point3& b) {
        return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2, a.z + (b.z - a.z) / 2};
    }

    [[nodiscard]] Part part_of(const Corners& c) {
        constexpr double endless = std::numeric_limits<double>::infinity();
        Part part{endless, c};
        for (const Point3& p : {c[0], c[1], c[2], middle(c[0], middle(c[1], c[2]))}) {
            const auto near = tree_->nearest(p, endless);
            if (!near) continue;
            least_ = std::max(least_, near->distance);
            const auto& [i, j, k] = near->triangle;
            double farthest = 0;
            for (const Point3& q : c)
                farthest =
                    std::max(farthest, distance_to_triangle(q, to_.vertices[i], to_.vertices[j],
                                                            to_.vertices[k]));
            part.most = std::min(part.most, farthest);
        }
        return part;
    }

    const Surface& to_;
    std::optional<TriangleTree> tree_;
    double least_ = 0; ///< the largest distance of a point that was looked at
};

/// The origins of the triangles of an arrangement of grown surfaces.
class Growth {
public:
    Growth(const Arrangement& whole, const std::vector<std::uint32_t>& dropped,
           std::span<const SurfaceGrowth> growth) :
        whole_(whole),
        growth_(growth), is_dropped_(whole.triangles.size()), is_outside_(whole.triangles.size()) {
        for (const std::uint32_t t : dropped) is_dropped_[t] = true;
        for (const PointIndex v : whole.vertices) places_.push_back(whole.state->points.nearest(v));
    }

    Status locate_outside(std::size_t boundary_count, const Run& run) {
        if (boundary_count == 0) return Done{};
        std::vector<std::uint32_t> boundary(boundary_count);
        std::iota(boundary.begin(), boundary.end(), static_cast<std::uint32_t>(growth_.size()));
        const auto where = locate(whole_, boundary, run);
        if (!where) return where.error();
        for (std::size_t t = 0; t < is_outside_.size(); ++t)
            is_outside_[t] = where.value()[t] == Where::outside;
        return Done{};
    }

    /// Bounds the distances for a surface; 0: it is as it was.
    [[nodiscard]] double limit_of(std::uint32_t surface, const Run& run) const {
        Surface given, added, trimmed, kept;
        for (Surface* s : {&given, &added, &trimmed, &kept}) s->vertices = places_;
        for (std::uint32_t t = 0; t < whole_.triangles.size(); ++t) {
            const auto of = whole_.surfaces_of[t];
            if (!std::binary_search(of.begin(), of.end(), surface)) continue;
            const bool is_given = is_given_for(t, surface);
            if (is_given) given.triangles.push_back(whole_.triangles[t]);
            if (!is_given && !is_dropped_[t]) added.triangles.push_back(whole_.triangles[t]);
            if (!is_given) continue;
            const bool is_trimmed = is_dropped_[t] && !is_outside_[t];
            (is_trimmed ? trimmed : kept).triangles.push_back(whole_.triangles[t]);
        }
        return std::max(DistanceBound(given)(added, run), DistanceBound(kept)(trimmed, run));
    }

private:
    /// Tells whether a given triangle of the surface contains a triangle.
    [[nodiscard]] bool is_given_for(std::uint32_t t, std::uint32_t surface) const {
        const std::uint32_t first = whole_.inputs.first[surface];
        const auto parents = whole_.parents_of[t];
        return std::any_of(parents.begin(), parents.end(), [&](std::uint32_t p) {
            return p >= first && p < first + growth_[surface].given;
        });
    }

    const Arrangement& whole_;
    std::span<const SurfaceGrowth> growth_;
    std::vector<bool> is_dropped_, is_outside_; ///< per triangle
    std::vector<Point3> places_;                ///< per vertex
};

void write_triangles(CertificateWriter& out, const Surface& surface, std::size_t first,
                     std::size_t last) {
    std::vector<std::vector<Point3>> triangles;
    for (std::size_t t = first; t < last; ++t)
        for (std::vector<Point3>& corners = triangles.emplace_back();
             const std::uint32_t v : surface.triangles[t])
            corners.push_back(surface.vertices[v]);
    out.array(
        triangles, [&](const auto& corners) { write_points(out, corners); }, ",\n");
}

} // namespace

Result<std::vector<double>> growth_limits(const Arrangement& whole,
                                          const std::vector<std::uint32_t>& dropped,
                                          const CutRecord& record, const Run& run) {
    Growth growth(whole, dropped, record.growth);
    if (auto located = growth.locate_outside(record.boundary_count, run); !located)
        return located.error();
    std::vector<double> limits;
    for (std::uint32_t s = 0; s < record.growth.size(); ++s)
        limits.push_back(growth.limit_of(s, run));
    if (!std::all_of(limits.begin(), limits.end(), [](double l) { return std::isfinite(l); }))
        return Error{ErrorCode::internal, "nothing is left of a surface that was trimmed",
                     "certificate"};
    return limits;
}

void write_growth(CertificateWriter& out, std::span<const Surface> surfaces,
                  std::span<const SurfaceGrowth> growth, std::span<const double> limits) {
    std::vector<std::size_t> numbers(growth.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    out.array(
        numbers,
        [&](std::size_t s) {
            out.raw("{\"limit\":");
            out.quote(limits[s]);
            out.raw(",\"extended\":");
            write_triangles(out, surfaces[s], growth[s].given, growth[s].extended);
            out.raw(",\n\"sealed\":");
            write_triangles(out, surfaces[s], growth[s].extended, surfaces[s].triangles.size());
            out.raw("}");
        },
        ",\n");
}

} // namespace terrane::detail
