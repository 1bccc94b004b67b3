// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/flat_hole.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/reconstruction/holes/flatness.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/data.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace kriging::detail;

namespace {

using kriging::detail::constants;

Error stopped() {
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
                             place_text(p)};
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
    const auto places =
        places_within(points, data.borders, mesh_size, constants.most_places, run.stop);
    if (run.stop.stop_requested()) return stopped();
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

/// Sets the heights of interpolated vertices. Returns the expected error per vertex, 0 on the
/// borders.
std::vector<double> set_heights(FlatFilling& flat, const HeightSource& source) {
    const auto known = source(std::span(flat.points).subspan(flat.border));
    std::vector<double> expected_error(flat.border, 0);
    for (std::size_t i = 0; i < known.heights.size(); ++i)
        flat.points[flat.border + i].z = known.heights[i];
    expected_error.insert(expected_error.end(), known.expected.begin(), known.expected.end());
    return expected_error;
}

/// Tells whether smaller triangles would bring the filling nearer to the truth.
bool is_too_flat(const FlatFilling& flat, const HeightSource& source, double mesh_size) {
    const auto edges =
        detail::some_inner_edges(flat.triangles, flat.points.size(), constants.most_sags);
    std::vector<Point3> places;
    for (const auto& [a, b] : edges) {
        const Point3 &p = flat.points[a], &q = flat.points[b];
        places.insert(places.end(), {p, q, detail::middle_of(p, q)});
    }
    const auto known = source(places);
    std::vector<double> sags, expected;
    for (std::size_t i = 0; i < places.size(); i += 3) {
        // Estimates, not data: noise at the border does not count.
        sags.push_back(known.heights[i + 2] - (known.heights[i] + known.heights[i + 1]) / 2);
        expected.push_back(known.expected[i + 2]);
    }
    return detail::flatness_outweighs(sags, expected, mesh_size);
}

double root_mean_square(std::span<const double> values) {
    const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    return std::sqrt(squares / static_cast<double>(values.size()));
}

/// Computes the expected error of triangles between border vertices alone, at their middles: how far
/// they are from the estimates, and these from the truth.
double error_of_flat(const FlatFilling& flat, const HeightSource& source) {
    std::vector<Point3> middles;
    for (const Triangle& t : flat.triangles) {
        const Point3 &a = flat.points[t[0]], &b = flat.points[t[1]], &c = flat.points[t[2]];
        middles.push_back({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3});
    }
    const auto known = source(middles);
    std::vector<double> errors;
    for (std::size_t i = 0; i < middles.size(); ++i)
        errors.push_back(std::hypot(known.expected[i], known.heights[i] - middles[i].z));
    return root_mean_square(errors);
}

double area_of(const Surface& s) {
    double sum = 0;
    for (const Triangle& t : s.triangles)
        sum += area_between(s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]);
    return sum;
}

} // namespace

struct FlatHole::State {
    Surface named; ///< name and role of the surface, no more
    KrigingData data;
    std::size_t border = 0;
    double area = 0;      ///< positive if the loop is counterclockwise
    double mesh_size = 0; ///< as used
    bool given = false;   ///< whether a mesh size was
    FlatFilling flat;
};

FlatHole::FlatHole(std::unique_ptr<State> state) : state_(std::move(state)) {}
FlatHole::FlatHole(FlatHole&&) noexcept = default;
FlatHole& FlatHole::operator=(FlatHole&&) noexcept = default;
FlatHole::~FlatHole() = default;

Result<FlatHole> FlatHole::of(const Surface& surface, const BorderLoop& loop,
                              std::span<const BorderLoop> loops, std::size_t rings,
                              const Run& run) {
    const double edge = loop.length / std::max(1.0, static_cast<double>(loop.vertices.size()));
    const double reach = constants.reach * std::sqrt(loop.area / std::numbers::pi);
    const RingRange range{rings, edge > 0 ? std::floor(reach / edge) : 0};
    auto found = collect_data(surface, loops_within(surface, loop, loops), range, run);
    if (!found) return found.error();
    auto state = std::make_unique<State>();
    state->named = {surface.name, surface.role, {}, {}};
    state->data = std::move(found).value();
    for (const Polygon& polygon : state->data.borders) state->border += polygon.size();
    state->area = signed_area(state->data.points, state->data.borders[0]);
    if (state->area == 0 || !(median_edge(state->data.points, state->data.borders[0]) > 0))
        return Error{ErrorCode::nothing_to_do, "the hole has no area, seen from above",
                     place_text(loop.centre)};
    return FlatHole(std::move(state));
}

const std::vector<Point3>& FlatHole::data() const {
    return state_->data.points;
}

std::size_t FlatHole::border() const {
    return state_->border;
}

double FlatHole::radius() const {
    return std::sqrt(std::abs(state_->area) / std::numbers::pi);
}

double FlatHole::mesh_size() const {
    return state_->mesh_size;
}

Status FlatHole::triangulate(double mesh_size, const Run& run) {
    State& s = *state_;
    s.given = mesh_size > 0;
    s.mesh_size = s.given ? mesh_size : median_edge(s.data.points, s.data.borders[0]);
    auto flat = mesh_of(s.data, s.mesh_size, run);
    if (!flat) return flat.error();
    s.flat = std::move(flat).value();
    return Done{};
}

Result<Filling> FlatHole::filled(const HeightSource& source, const Run& run) {
    State& s = *state_;
    Filling filling;
    filling.expected_error = set_heights(s.flat, source);
    for (unsigned halvings = 0; !s.given && halvings < detail::most_halvings; ++halvings) {
        if (4 * (s.flat.points.size() - s.border) > constants.most_places ||
            run.stop.stop_requested() || !is_too_flat(s.flat, source, s.mesh_size))
            break;
        s.mesh_size /= 2;
        auto flat = mesh_of(s.data, s.mesh_size, run);
        if (!flat) return flat.error();
        s.flat = std::move(flat).value();
        filling.expected_error = set_heights(s.flat, source);
    }
    if (run.stop.stop_requested()) return stopped();
    filling.surface = {s.named.name, s.named.role, s.flat.points, s.flat.triangles};
    filling.exact_border = true;
    if (s.area > 0) // the loop has the surface on its left, which here means front down
        for (Triangle& t : filling.surface.triangles) std::swap(t[1], t[2]);
    filling.report.interpolated = filling.surface.vertices.size() - s.border;
    filling.report.area = area_of(filling.surface);
    filling.report.expected_error =
        filling.report.interpolated > 0
            ? root_mean_square(std::span(filling.expected_error).subspan(s.border))
            : error_of_flat(s.flat, source);
    return filling;
}

} // namespace terrane
