// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/detail/growth_writer.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/quality/deviation.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace terrane::detail {

namespace {

/// What became of the triangles of an arrangement of grown surfaces.
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
        return std::max(bound(added, given, run), bound(trimmed, kept, run));
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

    static double bound(const Surface& from, const Surface& to, const Run& run) {
        constexpr double slack = 1.0 / 32;
        if (from.triangles.empty()) return 0;
        double largest = 0;
        for (const Triangle& t : from.triangles)
            for (const std::uint32_t v : t)
                for (const double c : {from.vertices[v].x, from.vertices[v].y, from.vertices[v].z})
                    largest = std::max(largest, std::fabs(c));
        const double sampled = sampled_distance(from, to, run);
        if (!std::isfinite(sampled)) return sampled;
        const double tolerance = std::max(slack * sampled, std::ldexp(largest, -30));
        return (1 + slack) * distance_bound(from, to, tolerance, run);
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
