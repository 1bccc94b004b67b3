// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/detail/gap_distances.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sealing/detail/constants.hpp>

namespace terrane::sealing::detail {
namespace {

/// Returns the least bound that is not nearer than a distance.
double beyond(double distance) {
    return std::nextafter(distance, HUGE_VAL);
}

std::vector<Point3> places_of(const Arrangement& a) {
    std::vector<Point3> places;
    for (const PointIndex v : a.vertices) places.push_back(a.state->points.nearest(v));
    return places;
}

} // namespace

GapDistances::GapDistances(const Arrangement& a, SealDistances distances) :
    arrangement_(a), distances_(std::move(distances)), places_(places_of(a)),
    near_({places_, a.triangles, a.surfaces_of}) {
    std::vector<std::vector<Triangle>> triangles(a.surfaces.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t)
        for (const std::uint32_t s : a.surfaces_of[t]) triangles[s].push_back(a.triangles[t]);
    for (auto& of_surface : triangles) trees_.emplace_back(places_, std::move(of_surface));
}

double GapDistances::bound(std::uint32_t surface, std::uint32_t other, double factor) const {
    const double distance = distances_.between(surface, other);
    return distance > 0 ? beyond(factor * distance) : 0;
}

/// Measures the parts of an edge of which both ends and the middle have a nearest point.
template <class Nearest>
std::optional<Gap> GapDistances::measured(const BorderEdge& edge, const Nearest& find) const {
    Gap gap{edge, 0, -1, {}, 0};
    for (const Edge& part : edge.open) {
        const Point3 &p = places_[part[0]], &q = places_[part[1]];
        Gap here{{}, length_between(p, q), -1, {}, 0};
        bool is_near = true;
        for (const Point3& at : {p, middle_of(p, q), q}) {
            const std::optional<Near> near = find(at);
            if (!near) {
                is_near = false;
                break;
            }
            const double d = length_between(at, near->place);
            if (d <= here.largest) continue;
            here.largest = d;
            here.place = at;
            here.to = near->surface;
        }
        if (!is_near) continue;
        gap.length += here.length;
        if (here.largest <= gap.largest) continue;
        gap.largest = here.largest;
        gap.place = here.place;
        gap.to = here.to;
    }
    if (gap.largest < 0) return std::nullopt;
    return gap;
}

std::optional<Gap> GapDistances::gap_at(const BorderEdge& edge) const {
    return measured(edge, [&](const Point3& p) { return nearest(p, edge); });
}

std::optional<Gap> GapDistances::own_gap_at(const BorderEdge& edge) const {
    return measured(edge, [&](const Point3& p) { return nearest_own(p, edge); });
}

std::optional<Gap> GapDistances::part_gap_at(const BorderEdge& edge) const {
    Gap gap{edge, 0, -1, {}, 0};
    const Point3 outward = outward_of(arrangement_, edge);
    for (const Edge& part : edge.open) {
        const Point3 &p = places_[part[0]], &q = places_[part[1]], at = middle_of(p, q);
        const auto near = nearest(at, edge);
        if (!near || (nearest(p, edge) && nearest(q, edge))) continue;
        const Point3 way = minus(near->place, at);
        const double d = length_between(at, near->place);
        if (dot(outward, way) < constants.least_ahead * d) continue;
        gap.length += length_between(p, q);
        if (d <= gap.largest) continue;
        gap.largest = d;
        gap.place = at;
        gap.to = near->surface;
    }
    if (gap.largest < 0) return std::nullopt;
    return gap;
}

std::optional<GapDistances::Near> GapDistances::nearest(const Point3& p, const BorderEdge& edge,
                                                        double factor) const {
    std::optional<Near> best;
    double least = HUGE_VAL;
    double reach = beyond(factor * distances_.largest());
    if (!distances_.has_exceptions()) // then no other surface can be the nearest
        if (const auto found = near_.nearest(p, edge.own, reach)) reach = found->reach;
    for (const std::uint32_t s : near_.within(p, edge.own, reach)) {
        const double most = std::min(least, bound(edge.surface, s, factor));
        if (!(most > 0)) continue;
        if (const auto near = trees_[s].nearest(p, most)) {
            best = Near{near->place, s};
            least = near->distance;
        }
    }
    return best;
}

bool GapDistances::is_any_ahead(const Point3& p, const BorderEdge& edge, std::uint32_t except,
                                double distance) const {
    const Point3 outward = outward_of(arrangement_, edge);
    for (const std::uint32_t s : near_.within(p, edge.own, distance)) {
        if (s == except) continue;
        const auto near = trees_[s].nearest(p, std::min(distance, bound(edge.surface, s)));
        if (near && dot(outward, minus(near->place, p)) > constants.least_ahead * near->distance)
            return true;
    }
    return false;
}

std::optional<GapDistances::Near> GapDistances::nearest_own(const Point3& p,
                                                            const BorderEdge& edge) const {
    const Point3 outward = outward_of(arrangement_, edge);
    std::optional<Near> best;
    double least = bound(edge.surface, edge.surface);
    if (!(least > 0)) return best;
    for (const auto& near : trees_[edge.surface].within(p, least)) {
        if (near.distance == 0 || near.distance >= least ||
            dot(outward, minus(near.place, p)) < constants.least_ahead * near.distance)
            continue;
        least = near.distance;
        best = Near{near.place, edge.surface};
    }
    return best;
}

} // namespace terrane::sealing::detail
