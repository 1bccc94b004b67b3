// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/reconstruction/holes/expected_points.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/average.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>
#include <terrane/algorithms/reconstruction/kriging/flat_hole.hpp>

namespace terrane {

using namespace kriging::detail;

namespace {

/// Records the experimental variogram of what the trend of the likeliest model leaves of the data,
/// in classes of its distance, and its variogram at distances up to theirs.
void record_variogram(std::span<const Point3> data, const WeighedModel& likeliest,
                      FillReport& report) {
    const TrendTerms trend(data, likeliest.degree);
    const Eigen::MatrixXd terms = trend.matrix(data);
    const Eigen::VectorXd heights = heights_of(data);
    const Contrasts contrasts(terms);
    Eigen::VectorXd numbers = heights;
    contrasts.apply(numbers);
    const Eigen::VectorXd left = heights - terms * contrasts.trend_of(numbers);
    std::vector<Point3> residuals(data.begin(), data.end());
    for (std::size_t i = 0; i < data.size(); ++i)
        residuals[i].z = left(static_cast<Eigen::Index>(i));
    const double longest = flat_extent_of(data) / 2;
    if (!(longest > 0)) return;
    report.variogram = experimental_variogram(residuals, likeliest.variogram, longest);
    constexpr std::size_t steps = 60;
    for (std::size_t i = 1; i <= steps; ++i) {
        const double distance = longest * static_cast<double>(i) / steps;
        report.variogram_model.push_back({distance, likeliest.variogram.at(distance)});
    }
}

/// Describes an average in a sentence.
std::string description(const ModelAverage& average) {
    const WeighedModel& first = average.models[0];
    auto text = average.models.size() == 1
                    ? description(first)
                    : fmt::format("{} models; the likeliest, {}, counts {}", average.models.size(),
                                  description(first), figure(first.weight, 2));
    text += average.blocks > 0
                ? fmt::format("; blocks as wide as the hole are missed by {}, {} times what is "
                              "expected",
                              figure(average.error, 4), figure(average.ratio, 3))
                : "; no blocks as wide as the hole can be left out";
    if (std::isfinite(average.rim_ratio))
        text += fmt::format(", its rim by {} times", figure(average.rim_ratio, 3));
    if (!average.unknown.empty())
        text += fmt::format("; no expected error can be told: {}", average.unknown);
    return text;
}

/// The interpolated vertex that is farthest from the border; none without any.
std::optional<Point3> middle_of(const Filling& filling, std::size_t border) {
    std::optional<Point3> middle;
    double farthest = -1;
    const auto& points = filling.surface.vertices;
    for (std::size_t v = border; v < points.size(); ++v) {
        double least = HUGE_VAL;
        for (std::size_t b = 0; b < border; ++b)
            least =
                std::min(least, std::hypot(points[b].x - points[v].x, points[b].y - points[v].y));
        if (!(least > farthest)) continue;
        farthest = least;
        middle = points[v];
    }
    return middle;
}

/// Completes the report of a filling.
void report_models(const FlatHole& hole, const ModelAverage& average,
                   const AveragedHeights& heights, Filling& filling) {
    FillReport& report = filling.report;
    report.data = hole.data().size();
    report.validated_error = average.error;
    report.left_out = average.left_out;
    report.model = description(average);
    record_variogram(hole.data(), average.models[0], report);
    const auto middle = middle_of(filling, hole.border());
    report.models = heights.shares_at(middle.value_or(Point3{}));
    if (middle) return;
    for (ModelShare& share : report.models) share.height = share.deviation = NAN;
}

} // namespace

Result<Filling> fill_by_kriging(const Surface& surface, const BorderLoop& loop,
                                const KrigingOptions& options, const Run& run) {
    return guarded("for the filling", "fill", [&]() -> Result<Filling> {
        if (options.rings < 1 || !(options.mesh_size >= 0) || !std::isfinite(options.mesh_size))
            return Error{ErrorCode::bad_option, "rings and mesh size must be positive", ""};
        if (auto sound = check_edge_length(loop, options.mesh_size); !sound) return sound.error();
        const Error interrupted{ErrorCode::interrupted, "interrupted", ""};
        // 1. Collect the data and check that they are a graph.
        auto hole = FlatHole::of(surface, loop, options.loops, options.rings, run);
        if (!hole) return hole.error();
        if (run.stop.stop_requested()) return interrupted;
        // 2. Build the mesh in the plane.
        if (const auto built = hole->triangulate(options.mesh_size, run); !built)
            return built.error();
        // 3. Weigh the models, and average what they say of heights.
        const DataAroundHole around{hole->data(), hole->border(), hole->radius(), hole->near()};
        const auto average = weigh_models(around, options, run);
        if (run.stop.stop_requested()) return interrupted;
        const AveragedHeights heights(around, average, run);
        auto filling = hole->filled(
            [&](std::span<const Point3> places) { return heights.at(places, run); }, run);
        if (filling) report_models(*hole, average, heights, *filling);
        return filling;
    });
}

Surface joined(const Surface& surface, const Filling& filling) {
    Surface result = surface;
    std::map<Point3, std::uint32_t> known; // border vertices of the filling: the lowest equal
                                           // vertex of the surface
    for (const Point3& p : filling.surface.vertices) known.emplace(p, UINT32_MAX);
    for (std::uint32_t v = 0; v < surface.vertices.size(); ++v)
        if (const auto at = known.find(surface.vertices[v]); at != known.end())
            at->second = std::min(at->second, v);
    std::vector<std::uint32_t> number;
    for (const Point3& p : filling.surface.vertices) {
        auto& v = known.at(p);
        if (v == UINT32_MAX) {
            v = static_cast<std::uint32_t>(result.vertices.size());
            result.vertices.push_back(p);
        }
        number.push_back(v);
    }
    for (const Triangle& t : filling.surface.triangles)
        result.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    return result;
}

std::vector<NamedConstant> kriging_constants() {
    return kriging::detail::constants.listed();
}

} // namespace terrane
