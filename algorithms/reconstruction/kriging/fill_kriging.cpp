// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/reconstruction/holes/flatness.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/data.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace kriging::detail;

namespace {

Error interrupted() {
    return {ErrorCode::interrupted, "interrupted", ""};
}

/// Lists the loop and the outer borders of other parts that lie within it.
std::vector<const BorderLoop*> loops_within(const Surface& surface, const BorderLoop& loop,
                                            std::span<const BorderLoop> all) {
    std::vector<const BorderLoop*> result{&loop};
    for (const BorderLoop& other : all) {
        if (other.kind != LoopKind::outer || other.part == loop.part) continue;
        const Point3& p = surface.vertices[other.vertices[0]];
        if (is_inside(surface.vertices, loop.vertices, p.x, p.y)) result.push_back(&other);
    }
    return result;
}

double median_edge(const std::vector<Point3>& points, const Polygon& polygon) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point3 &a = points[polygon[i]], &b = points[polygon[(i + 1) % polygon.size()]];
        lengths.push_back(std::hypot(b.x - a.x, b.y - a.y));
    }
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

/// Checks that each border edge has the surface on one side and the filling on the other.
Status check_sides(const KrigingData& data, std::span<const Point3> points,
                   std::span<const Triangle> triangles) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> third_of;
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) third_of[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
    std::size_t edge = 0;
    for (const Polygon& polygon : data.borders)
        for (std::size_t i = 0; i < polygon.size(); ++i, ++edge) {
            const auto a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            const auto along = third_of.find({a, b}), against = third_of.find({b, a});
            const auto found = along != third_of.end() ? along : against;
            const Point3 &p = points[a], &q = points[b];
            const Sign filled = found == third_of.end()
                                    ? Sign::Zero
                                    : orient2d(Axis::z, p, q, points[found->second]);
            const Point3& inner = data.points[data.inner_of[edge]];
            if (filled * orient2d(Axis::z, p, q, inner) != Sign::Negative)
                return Error{ErrorCode::unsupported,
                             "the surface is no graph z = f(x, y) next to the hole: it reaches "
                             "into the hole, seen from above; --method rbf can fill it",
                             fmt::format("({}, {}, {})", p.x, p.y, p.z)};
        }
    return Done{};
}

/// A filling before it has heights; contains only vertices of its triangles.
struct FlatFilling {
    std::vector<Point3> points; ///< border points first
    std::size_t border = 0;
    std::vector<Triangle> triangles; ///< front up
};

Result<FlatFilling> mesh_of(const KrigingData& data, double mesh_size, const Run& run) {
    FlatFilling flat;
    for (const Polygon& polygon : data.borders) flat.border += polygon.size();
    std::vector<Point3> points(data.points.begin(),
                               data.points.begin() + static_cast<std::ptrdiff_t>(flat.border));
    const auto places = places_within(points, data.borders, mesh_size, constants.most_places);
    points.insert(points.end(), places.begin(), places.end());
    auto triangles = triangulate_inside(points, data.borders, run);
    if (!triangles) {
        if (triangles.error().code != ErrorCode::improper_contact) return triangles.error();
        Error error = triangles.error();
        error.code = ErrorCode::unsupported;
        error.sentence = "the hole can't be filled as z = f(x, y): " + error.sentence +
                         "; --method rbf can fill it";
        return error;
    }
    std::vector<std::uint32_t> number(points.size(), UINT32_MAX);
    for (std::uint32_t i = 0; i < flat.border; ++i) number[i] = i;
    flat.points.assign(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(flat.border));
    for (Triangle t : triangles.value()) {
        for (auto& v : t) {
            if (number[v] == UINT32_MAX) {
                number[v] = static_cast<std::uint32_t>(flat.points.size());
                flat.points.push_back(points[v]);
            }
            v = number[v];
        }
        flat.triangles.push_back(t);
    }
    if (const auto status = check_sides(data, flat.points, flat.triangles); !status)
        return status.error();
    return flat;
}

/// The model, and what its standard deviations are worth.
struct FittedModel {
    Kriging kriging;
    bool determined = true;
    double rounding = 0; ///< least expected error
};

/// Sets the heights of interpolated vertices. Returns the expected error per vertex, 0 on the
/// borders.
std::vector<double> set_heights(FlatFilling& flat, const FittedModel& model, const Run& run) {
    const auto estimates = model.kriging.at(std::span(flat.points).subspan(flat.border), run);
    std::vector<double> expected_error(flat.points.size(), 0);
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        flat.points[flat.border + i].z = estimates[i].value;
        expected_error[flat.border + i] =
            model.determined ? std::hypot(estimates[i].standard_deviation, model.rounding)
                             : std::numeric_limits<double>::quiet_NaN();
    }
    return expected_error;
}

/// Tells whether smaller triangles would bring the filling nearer to the truth.
bool is_too_flat(const FlatFilling& flat, const Kriging& kriging, double mesh_size,
                 const Run& run) {
    const auto edges =
        detail::some_inner_edges(flat.triangles, flat.points.size(), constants.most_sags);
    std::vector<Point3> places;
    for (const auto& [a, b] : edges) {
        const Point3 &p = flat.points[a], &q = flat.points[b];
        places.insert(places.end(), {p, q, detail::middle_of(p, q)});
    }
    const auto estimates = kriging.at(places, run);
    std::vector<double> sags, expected;
    for (std::size_t i = 0; i < estimates.size(); i += 3) {
        const Estimate* e = &estimates[i]; // estimates, not data: noise at the border does not
                                           // count
        sags.push_back(e[2].value - (e[0].value + e[1].value) / 2);
        expected.push_back(e[2].standard_deviation);
    }
    return detail::flatness_outweighs(sags, expected, mesh_size);
}

double area_of(const Surface& s) {
    double sum = 0;
    for (const Triangle& t : s.triangles) {
        const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
        sum += std::hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
    }
    return sum;
}

/// Keeps all data if all can be used at once. Otherwise keeps those at the borders and, of the
/// others, as many as make `Kriging::most_at_once`, well spread.
std::vector<Point3> thinned(const KrigingData& data, std::size_t border) {
    const auto& all = data.points;
    if (all.size() <= Kriging::most_at_once || border > Kriging::most_at_once) return all;
    std::vector<Point3> kept(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(border));
    const auto others = std::span(all).subspan(border);
    for (const auto i : well_spread_in_plane(others, Kriging::most_at_once - border))
        kept.push_back(others[i]);
    return kept;
}

FittedModel model_of(const KrigingData& data, std::size_t border, const KrigingOptions& options,
                     FillReport& report, const Run& run) {
    const double area = std::abs(signed_area(data.points, data.borders[0]));
    const DataAroundHole around{data.points, border, std::sqrt(area / std::numbers::pi)};
    const auto choice = choose_model(around, options.variogram, run);
    FittedModel model{Kriging(thinned(data, border), choice.variogram, choice.degree, run),
                      choice.determined, rounding_of(data.points)};
    report.data = data.points.size();
    report.validated_error = choice.validation.blocks > 0
                                 ? choice.validation.error
                                 : std::numeric_limits<double>::quiet_NaN();
    report.model =
        fmt::format("trend of degree {}, {}; ", choice.degree, description(choice.variogram));
    report.model += choice.validation.blocks > 0
                        ? fmt::format("blocks as wide as the hole are missed by {:.4g}, {:.3g} "
                                      "times what the model expects",
                                      choice.validation.error, choice.validation.ratio)
                        : "no blocks as wide as the hole can be left out";
    return model;
}

} // namespace

Result<Filling> fill_by_kriging(const Surface& surface, const BorderLoop& loop,
                                const KrigingOptions& options, const Run& run) {
    if (options.rings < 1 || !(options.mesh_size >= 0) || !std::isfinite(options.mesh_size))
        return Error{ErrorCode::bad_option, "rings and mesh size must be positive", ""};
    // 1. Collect the data and check that they are a graph.
    const auto loops = loops_within(surface, loop, options.loops);
    auto found = collect_data(surface, loops, options.rings);
    if (!found) return found.error();
    const KrigingData& data = found.value();
    const double area = signed_area(data.points, data.borders[0]);
    double mesh_size =
        options.mesh_size > 0 ? options.mesh_size : median_edge(data.points, data.borders[0]);
    if (area == 0 || !(mesh_size > 0))
        return Error{ErrorCode::nothing_to_do, "the hole has no area, seen from above",
                     fmt::format("({}, {}, {})", loop.centre.x, loop.centre.y, loop.centre.z)};
    if (run.stop.stop_requested()) return interrupted();
    // 2. Build the mesh in the plane.
    auto flat = mesh_of(data, mesh_size, run);
    if (!flat) return flat.error();
    const auto border = flat.value().border;
    // 3. Estimate the heights.
    Filling filling;
    const auto model = model_of(data, border, options, filling.report, run);
    if (run.stop.stop_requested()) return interrupted();
    filling.expected_error = set_heights(flat.value(), model, run);
    for (unsigned halvings = 0; options.mesh_size == 0 && halvings < detail::most_halvings;
         ++halvings) {
        if (4 * (flat.value().points.size() - border) > constants.most_places ||
            run.stop.stop_requested() || !is_too_flat(flat.value(), model.kriging, mesh_size, run))
            break;
        mesh_size /= 2;
        flat = mesh_of(data, mesh_size, run);
        if (!flat) return flat.error();
        filling.expected_error = set_heights(flat.value(), model, run);
    }
    if (run.stop.stop_requested()) return interrupted();
    filling.surface = {surface.name, surface.role, std::move(flat.value().points),
                       std::move(flat.value().triangles)};
    filling.exact_border = true;
    if (area > 0) // the loop has the surface on its left, which here means front down
        for (Triangle& t : filling.surface.triangles) std::swap(t[1], t[2]);
    filling.report.interpolated = filling.surface.vertices.size() - border;
    filling.report.area = area_of(filling.surface);
    const double squares =
        std::inner_product(filling.expected_error.begin(), filling.expected_error.end(),
                           filling.expected_error.begin(), 0.0);
    filling.report.expected_error =
        squares == 0 ? 0 : std::sqrt(squares / static_cast<double>(filling.report.interpolated));
    return filling;
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
    return kriging::detail::named_constants();
}

} // namespace terrane
