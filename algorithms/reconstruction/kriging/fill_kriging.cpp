// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/reconstruction/holes/expected_points.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/direction_doubt.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>
#include <terrane/algorithms/reconstruction/kriging/flat_hole.hpp>

namespace terrane {

using namespace kriging::detail;

namespace {

/// The model, and what its standard deviations are worth.
struct FittedModel {
    Kriging kriging;
    DirectionDoubt doubt;
    bool determined = true;
    double rounding = 0; ///< least expected error
};

KnownHeights heights_of(const FittedModel& model, std::span<const Point3> places, const Run& run) {
    KnownHeights known;
    const auto estimates = model.kriging.at(places, run);
    const auto doubts = model.doubt.at(places, run);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Estimate& e = estimates[i];
        known.heights.push_back(e.value);
        known.expected.push_back(model.determined
                                     ? std::hypot(e.standard_deviation, model.rounding, doubts[i])
                                     : std::numeric_limits<double>::quiet_NaN());
    }
    return known;
}

/// Keeps all data if all can be used at once. Otherwise keeps those at the borders and, of the
/// others, as many as make `Kriging::most_at_once`, well spread.
std::vector<Point3> thinned(const std::vector<Point3>& all, std::size_t border) {
    if (all.size() <= Kriging::most_at_once || border > Kriging::most_at_once) return all;
    std::vector<Point3> kept(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(border));
    const auto others = std::span(all).subspan(border);
    for (const auto i : well_spread_in_plane(others, Kriging::most_at_once - border))
        kept.push_back(others[i]);
    return kept;
}

/// Records the experimental variogram of what the trend leaves of the data, in classes of the
/// model's distance, and the model at distances up to theirs.
void record_variogram(std::span<const Point3> data, const Variogram& model, unsigned degree,
                      FillReport& report) {
    constexpr std::size_t classes = 15, steps = 60;
    const TrendTerms trend(data, degree);
    const Eigen::MatrixXd terms = trend.matrix(data);
    Eigen::VectorXd heights(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i) heights(static_cast<Eigen::Index>(i)) = data[i].z;
    const Eigen::VectorXd left = heights - terms * terms.colPivHouseholderQr().solve(heights);
    std::vector<Point3> residuals(data.begin(), data.end());
    Point3 least = data.front(), largest = data.front();
    for (std::size_t i = 0; i < data.size(); ++i) {
        const Point3& p = data[i];
        residuals[i].z = left(static_cast<Eigen::Index>(i));
        least = {std::min(least.x, p.x), std::min(least.y, p.y), 0};
        largest = {std::max(largest.x, p.x), std::max(largest.y, p.y), 0};
    }
    const double longest = std::hypot(largest.x - least.x, largest.y - least.y) / 2;
    if (!(longest > 0)) return;
    struct Class {
        double distance = 0, gamma = 0, pairs = 0;
    };
    const auto bins = experimental_variogram(residuals, {}, longest);
    double farthest = 0;
    for (const VariogramBin& bin : bins)
        farthest = std::max(farthest, model.distance(bin.dx, bin.dy));
    if (!(farthest > 0)) return;
    std::array<Class, classes> sums{};
    for (const VariogramBin& bin : bins) {
        const double distance = model.distance(bin.dx, bin.dy);
        const auto at = static_cast<std::size_t>(classes * distance / farthest);
        Class& sum = sums[std::min(at, classes - 1)];
        const auto pairs = static_cast<double>(bin.pairs);
        sum = {sum.distance + pairs * distance, sum.gamma + pairs * bin.gamma, sum.pairs + pairs};
    }
    for (const Class& sum : sums)
        if (sum.pairs > 0)
            report.variogram.push_back({sum.distance / sum.pairs, sum.gamma / sum.pairs});
    for (std::size_t i = 1; i <= steps; ++i) {
        const double distance = farthest * static_cast<double>(i) / steps;
        report.variogram_model.push_back({distance, model.at(distance)});
    }
}

FittedModel model_of(const FlatHole& hole, const KrigingOptions& options, FillReport& report,
                     const Run& run) {
    const auto& data = hole.data();
    const auto choice = choose_model({data, hole.border(), hole.radius()}, options.variogram, run);
    FittedModel model{
        Kriging(thinned(data, hole.border()), choice.variogram, choice.degree, run,
                choice.validation.noise_share),
        DirectionDoubt(error_data(data, hole.border(), choice.variogram), choice, run),
        choice.determined, rounding_of(data, choice.degree)};
    report.data = data.size();
    record_variogram(data, choice.variogram, choice.degree, report);
    report.left_out = choice.validation.left_out;
    report.validated_error = choice.validation.blocks > 0
                                 ? choice.validation.error
                                 : std::numeric_limits<double>::quiet_NaN();
    report.model =
        fmt::format("trend of degree {}, {}; ", choice.degree, description(choice.variogram));
    report.model +=
        choice.validation.blocks > 0
            ? fmt::format("blocks as wide as the hole are missed by {}, {} "
                          "times what the model expects",
                          figure(choice.validation.error, 4), figure(choice.validation.ratio, 3))
            : "no blocks as wide as the hole can be left out";
    return model;
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
        // 3. Estimate the heights.
        FillReport report;
        const auto model = model_of(*hole, options, report, run);
        if (run.stop.stop_requested()) return interrupted;
        auto filling = hole->filled(
            [&](std::span<const Point3> places) { return heights_of(model, places, run); }, run);
        if (!filling) return filling;
        filling->report.data = report.data;
        filling->report.validated_error = report.validated_error;
        filling->report.model = report.model;
        filling->report.variogram = std::move(report.variogram);
        filling->report.variogram_model = std::move(report.variogram_model);
        filling->report.left_out = std::move(report.left_out);
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
