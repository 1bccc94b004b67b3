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

Error stopped() {
    return {ErrorCode::interrupted, "interrupted", ""};
}

/// Lists the loop and the outer borders of other parts that lie within it.
std::vector<const BorderLoop*> loops_within(const Surface& surface, const BorderLoop& loop,
                                            std::span<const BorderLoop> all) {
    std::vector<const BorderLoop*> result{&loop};
    for (const BorderLoop& other : all) {
        if (other.kind != LoopKind::outer || other.part == loop.part) continue;
        // The island may touch the hole's border in a vertex.
        const Point3 p =
            middle_of(surface.vertices[other.vertices[0]], surface.vertices[other.vertices[1]]);
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

} // namespace

Result<FlatHole> FlatHole::of(const Surface& surface, const BorderLoop& loop,
                              std::span<const BorderLoop> loops, std::size_t rings,
                              const Run& run) {
    const double edge = loop.length / std::max(1.0, static_cast<double>(loop.vertices.size()));
    // A surface may be of another kind farther away than the hole is wide.
    const double radius = std::sqrt(loop.area / std::numbers::pi);
    const RingRange range{rings, edge > 0 ? std::floor(radius / edge) : 0};
    auto found = collect_data(surface, loops_within(surface, loop, loops), range, run);
    if (!found) return found.error();
    FlatHole hole;
    hole.named_ = {surface.name, surface.role, {}, {}};
    hole.data_ = std::move(found).value();
    hole.area_ = signed_area(hole.data_.points, hole.data_.borders[0]);
    if (hole.area_ == 0 || !(median_edge(hole.data_.points, hole.data_.borders[0]) > 0))
        return Error{ErrorCode::nothing_to_do, "the hole has no area, seen from above",
                     place_text(loop.centre)};
    return hole;
}

double FlatHole::radius() const {
    return std::sqrt(std::abs(area_) / std::numbers::pi);
}

Status FlatHole::triangulate(double mesh_size, const Run& run) {
    given_ = mesh_size > 0;
    mesh_size_ = given_ ? mesh_size : median_edge(data_.points, data_.borders[0]);
    return build(run);
}

Status FlatHole::build(const Run& run) {
    const auto on_border = static_cast<std::ptrdiff_t>(border());
    std::vector<Point3> points(data_.points.begin(), data_.points.begin() + on_border);
    const auto places =
        places_within(points, data_.borders, mesh_size_, constants.most_places, run.stop);
    if (run.stop.stop_requested()) return stopped();
    points.insert(points.end(), places.begin(), places.end());
    auto triangles = triangulate_inside(points, data_.borders, run);
    if (!triangles) {
        if (triangles.error().code != ErrorCode::improper_contact) return triangles.error();
        Error error = triangles.error();
        error.code = ErrorCode::unsupported;
        error.sentence = "the hole can't be filled as z = f(x, y): " + error.sentence +
                         "; --method rbf can fill it";
        return error;
    }
    // Only vertices of triangles are kept.
    std::vector<std::uint32_t> number(points.size(), UINT32_MAX);
    std::iota(number.begin(), number.begin() + on_border, 0U);
    mesh_ = {{points.begin(), points.begin() + on_border}, {}};
    for (Triangle t : triangles.value()) {
        for (auto& v : t) {
            if (number[v] == UINT32_MAX) {
                number[v] = static_cast<std::uint32_t>(mesh_.points.size());
                mesh_.points.push_back(points[v]);
            }
            v = number[v];
        }
        mesh_.triangles.push_back(t);
    }
    return check_sides();
}

/// Checks that each border edge has the surface on one side and the filling on the other.
Status FlatHole::check_sides() const {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> third_of;
    for (const Triangle& t : mesh_.triangles)
        for (unsigned i = 0; i < 3; ++i) third_of[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
    std::size_t edge = 0;
    for (const Polygon& polygon : data_.borders)
        for (std::size_t i = 0; i < polygon.size(); ++i, ++edge) {
            const auto a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            const auto along = third_of.find({a, b}), against = third_of.find({b, a});
            const auto found = along != third_of.end() ? along : against;
            const Point3 &p = mesh_.points[a], &q = mesh_.points[b];
            const Sign filled = found == third_of.end()
                                    ? Sign::Zero
                                    : orient2d(Axis::z, p, q, mesh_.points[found->second]);
            const Point3& inner = data_.points[data_.inner_of[edge]];
            if (filled * orient2d(Axis::z, p, q, inner) != Sign::Negative)
                return Error{ErrorCode::unsupported,
                             "the surface is no graph z = f(x, y) next to the hole: it reaches "
                             "into the hole, seen from above; --method rbf can fill it",
                             place_text(p)};
        }
    return Done{};
}

/// Sets the heights of interpolated vertices. Returns the expected error per vertex, 0 on the
/// borders.
std::vector<double> FlatHole::set_heights(const HeightSource& source) {
    const auto known = source(std::span(mesh_.points).subspan(border()));
    std::vector<double> expected_error(border(), 0);
    for (std::size_t i = 0; i < known.heights.size(); ++i)
        mesh_.points[border() + i].z = known.heights[i];
    expected_error.insert(expected_error.end(), known.expected.begin(), known.expected.end());
    return expected_error;
}

/// Tells whether smaller triangles would bring the filling nearer to the truth.
bool FlatHole::is_too_flat(const HeightSource& source) const {
    std::vector<Point3> places;
    for (const auto& [a, b] :
         detail::some_inner_edges(mesh_.triangles, mesh_.points.size(), constants.most_sags)) {
        const Point3 &p = mesh_.points[a], &q = mesh_.points[b];
        places.insert(places.end(), {p, q, middle_of(p, q)});
    }
    const auto known = source(places);
    std::vector<double> sags, expected;
    for (std::size_t i = 0; i < places.size(); i += 3) {
        // Estimates, not data: noise at the border does not count.
        sags.push_back(known.heights[i + 2] - (known.heights[i] + known.heights[i + 1]) / 2);
        expected.push_back(known.expected[i + 2]);
    }
    return detail::flatness_outweighs(sags, expected, mesh_size_);
}

/// Computes the expected error of triangles between border vertices alone, at their middles: how far
/// they are from the estimates, and these from the truth.
double FlatHole::error_of_flat(const HeightSource& source) const {
    std::vector<Point3> middles;
    for (const Triangle& t : mesh_.triangles)
        middles.push_back(centre_of(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]));
    const auto known = source(middles);
    std::vector<double> errors;
    for (std::size_t i = 0; i < middles.size(); ++i)
        errors.push_back(std::hypot(known.expected[i], known.heights[i] - middles[i].z));
    return detail::root_mean_square(errors);
}

Result<Filling> FlatHole::filled(const HeightSource& source, const Run& run) {
    Filling filling;
    filling.expected_error = set_heights(source);
    for (unsigned halvings = 0; !given_ && halvings < detail::most_halvings; ++halvings) {
        if (4 * (mesh_.points.size() - border()) > constants.most_places ||
            run.stop.stop_requested() || !is_too_flat(source))
            break;
        mesh_size_ /= 2;
        if (const auto built = build(run); !built) return built.error();
        filling.expected_error = set_heights(source);
    }
    if (run.stop.stop_requested()) return stopped();
    filling.surface = {named_.name, named_.role, mesh_.points, mesh_.triangles};
    filling.exact_border = true;
    if (area_ > 0) // the loop has the surface on its left, which here means front down
        for (Triangle& t : filling.surface.triangles) std::swap(t[1], t[2]);
    filling.report.interpolated = mesh_.points.size() - border();
    filling.report.area = area_of(filling.surface);
    filling.report.expected_error =
        filling.report.interpolated > 0
            ? detail::root_mean_square(std::span(filling.expected_error).subspan(border()))
            : error_of_flat(source);
    return filling;
}

} // namespace terrane
