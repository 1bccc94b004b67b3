// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/plots.hpp>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/quality/quality.hpp>

namespace terrane::page {
namespace {

/// The measures of a mesh that are drawn.
struct Measured {
    std::vector<double> q, angles, edges;
};

Measured measured(const Mesh& mesh) {
    Measured result;
    for (const Triangle& t : mesh.triangles) {
        const Point3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        result.q.push_back(quality_of(a, b, c));
        const auto angles = angles_of(a, b, c);
        result.angles.push_back(std::min({angles[0], angles[1], angles[2]}));
        const auto edge = [&](const Point3& p, const Point3& r) {
            result.edges.push_back(distance_between(p, r));
        };
        edge(a, b);
        edge(b, c);
        edge(c, a);
    }
    return result;
}

std::vector<double> even_bounds(double from, double to, std::size_t classes) {
    std::vector<double> bounds;
    for (std::size_t i = 0; i <= classes; ++i)
        bounds.push_back(from +
                         (to - from) * static_cast<double>(i) / static_cast<double>(classes));
    return bounds;
}

/// Returns bounds of 1, 2, 5, 10, ... round all positive values.
std::vector<double> decade_bounds(double least, double largest) {
    std::vector<double> bounds;
    for (double decade = std::floor(std::log10(least));; ++decade)
        for (const double step : {1.0, 2.0, 5.0}) {
            const double bound = step * std::pow(10, decade);
            if (bound <= least) bounds.clear();
            bounds.push_back(bound);
            if (bound > largest) return bounds;
        }
}

/// Counts values by class; what is outside counts for the nearest class.
std::vector<std::size_t> counts_of(const std::vector<double>& values,
                                   const std::vector<double>& bounds) {
    std::vector<std::size_t> counts(bounds.size() - 1);
    for (const double value : values) {
        const auto after = std::upper_bound(bounds.begin(), bounds.end(), value);
        const auto at = std::distance(bounds.begin(), after) - 1;
        ++counts[static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(at, 0, static_cast<std::ptrdiff_t>(counts.size()) - 1))];
    }
    return counts;
}

Json axis(const char* label, const char* measure) {
    return {{"label", label}, {"measure", measure}};
}

Json plot_of(const char* title, Json x, const char* counted, const std::vector<double>& bounds) {
    return {{"title", title},
            {"x", std::move(x)},
            {"y", axis(counted, "count")},
            {"bounds", bounds},
            {"series", Json::array()}};
}

Json line_of(const char* name, std::vector<std::array<double, 2>> points, bool dots) {
    std::sort(points.begin(), points.end());
    Json x = Json::array(), y = Json::array();
    for (const auto& point : points) {
        x.push_back(point[0]);
        y.push_back(point[1]);
    }
    return {{"name", name}, {"x", x}, {"y", y}, {"dots", dots}};
}

} // namespace

void add_triangle_plots(Json& plots, const Mesh& mesh, const Mesh* before) {
    if (mesh.triangles.empty()) return;
    const Measured now = measured(mesh);
    const Measured then = before != nullptr ? measured(*before) : Measured();
    double least = HUGE_VAL, largest = 0;
    for (const auto* edges : {&now.edges, &then.edges})
        for (const double length : *edges) {
            if (length > 0) least = std::min(least, length);
            largest = std::max(largest, length);
        }
    const auto add = [&](Json plot, const std::vector<double>& bounds, auto member) {
        if (before != nullptr)
            plot["series"].push_back(
                {{"name", "before"}, {"values", counts_of(then.*member, bounds)}});
        plot["series"].push_back({{"name", before != nullptr ? "after" : "triangles"},
                                  {"values", counts_of(now.*member, bounds)}});
        plots.push_back(std::move(plot));
    };
    const auto q = even_bounds(0, 1, 20), angles = even_bounds(0, 60, 20);
    add(plot_of("Quality q of triangles (1: equilateral)", axis("q = 2 r / R", "quality"),
                "triangles", q),
        q, &Measured::q);
    add(plot_of("Smallest angle of each triangle", axis("smallest angle", "angle"), "triangles",
                angles),
        angles, &Measured::angles);
    if (!(largest > 0) || !std::isfinite(largest)) return;
    const auto lengths = decade_bounds(least, largest);
    add(plot_of("Lengths of edges", axis("edge length", "length"), "sides of triangles", lengths),
        lengths, &Measured::edges);
}

void add_tetrahedra_plots(Json& plots, const TetrahedraShape& shape) {
    if (shape.count == 0) return;
    const auto add = [&](Json plot, const char* counted, const auto& values) {
        plot["series"].push_back({{"name", counted}, {"values", values}});
        plots.push_back(std::move(plot));
    };
    add(plot_of("Dihedral angles of tetrahedra", axis("dihedral angle", "angle"), "angles",
                even_bounds(0, 180, dihedral_bins)),
        "angles", shape.dihedral_histogram);
    const auto tenths = even_bounds(0, 1, quality_bins);
    add(plot_of("SICN of tetrahedra (1: regular)", axis("signed inverse condition", "quality"),
                "tetrahedra", tenths),
        "tetrahedra", shape.sicn_histogram);
    add(plot_of("SHAPE of tetrahedra (1: regular)", axis("mean ratio", "quality"), "tetrahedra",
                tenths),
        "tetrahedra", shape.mean_ratio_histogram);
    Json bad = plot_of("Tetrahedra with an angle below 10 degrees", axis("cause", "name"),
                       "tetrahedra", {});
    bad.erase("bounds");
    bad["names"] = {"input angle", "thin triangle", "gap", "other"}; // in the order of BadCause
    std::array<std::size_t, bad_causes> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = shape.bad[i].count;
    add(std::move(bad), "tetrahedra", counts);
}

void add_gap_plot(Json& plots, const std::vector<FreeBorder>& borders) {
    std::map<int, double> lengths;
    for (const FreeBorder& border : borders)
        for (const BorderGap& gap : border.gaps)
            if (gap.decade != INT_MIN) lengths[gap.decade] += gap.length;
    if (lengths.empty()) return;
    std::vector<double> bounds, values;
    for (int d = lengths.begin()->first; d <= lengths.rbegin()->first; ++d) {
        bounds.push_back(std::pow(10, d));
        values.push_back(lengths.count(d) > 0 ? lengths.at(d) : 0);
    }
    bounds.push_back(std::pow(10, lengths.rbegin()->first + 1));
    Json plot = plot_of("Free borders by distance from the nearest surface",
                        axis("distance", "length"), "length of borders", bounds);
    plot["y"] = axis("length of borders", "length");
    plot["series"].push_back({{"name", "borders"}, {"values", values}});
    plots.push_back(std::move(plot));
}

void add_fill_plots(Json& plots, const FillWork& work) {
    constexpr std::size_t most = 6;
    std::vector<const NumberedHole*> holes;
    for (const NumberedHole& hole : work.holes)
        if (hole.report) holes.push_back(&hole);
    std::stable_sort(holes.begin(), holes.end(), [](const auto* a, const auto* b) {
        return a->report->area > b->report->area;
    });
    if (holes.size() > most) holes.resize(most);
    for (const NumberedHole* hole : holes) {
        const FillReport& r = *hole->report;
        const auto of = fmt::format("hole {} of {}", hole->number, work.surfaces[hole->task].label);
        if (!r.variogram.empty())
            plots.push_back({{"title", "Variogram of " + of},
                             {"x", axis("distance", "length")},
                             {"y", axis("half the mean squared difference", "area")},
                             {"lines", Json::array({line_of("data", r.variogram, true),
                                                    line_of("model", r.variogram_model, false)})}});
        if (r.left_out.empty()) continue;
        auto [low, high] = std::pair(r.left_out.front()[0], r.left_out.front()[0]);
        for (const auto& pair : r.left_out) {
            low = std::min(low, pair[0]);
            high = std::max(high, pair[0]);
        }
        plots.push_back(
            {{"title", "Cross-validation of " + of},
             {"x", axis("height of data that were left out", "height")},
             {"y", axis("height as predicted", "height")},
             {"lines", Json::array({line_of("left out", r.left_out, true),
                                    line_of("equal", {{low, low}, {high, high}}, false)})}});
    }
}

void add_volume_plot(Json& plots, const Model& model) {
    constexpr std::size_t most = 40;
    std::vector<std::pair<double, std::size_t>> volumes;
    for (std::size_t b = 1; b < model.exact_volumes.size(); ++b)
        volumes.emplace_back(-model.exact_volumes[b], b);
    if (volumes.empty()) return;
    std::sort(volumes.begin(), volumes.end());
    if (volumes.size() > most) volumes.resize(most);
    Json names = Json::array(), values = Json::array(), blocks = Json::array();
    for (const auto& [minus, b] : volumes) {
        names.push_back(fmt::format("{}", b));
        values.push_back(-minus);
        blocks.push_back(b);
    }
    plots.push_back({{"title", model.block_count() > most ? "Volumes of the 40 largest blocks"
                                                          : "Volumes of the blocks"},
                     {"x", axis("block", "name")},
                     {"y", axis("volume", "volume")},
                     {"names", names},
                     {"blocks", blocks},
                     {"series", Json::array({{{"name", "volume"}, {"values", values}}})}});
}

} // namespace terrane::page
