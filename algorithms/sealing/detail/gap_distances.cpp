// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/detail/gap_distances.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::sealing::detail {
namespace {

Point3 middle(const Point3& p, const Point3& q) {
    return {p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2, p.z + (q.z - p.z) / 2};
}

} // namespace

GapDistances::GapDistances(const Arrangement& a, double bound) :
    bound_(std::nextafter(bound, HUGE_VAL)) {
    for (const PointIndex v : a.vertices) places_.push_back(a.state->points.nearest(v));
    std::vector<std::vector<Triangle>> triangles(a.surfaces.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t)
        for (const std::uint32_t s : a.surfaces_of[t]) triangles[s].push_back(a.triangles[t]);
    for (auto& of_surface : triangles) trees_.emplace_back(places_, std::move(of_surface));
}

std::optional<Gap> GapDistances::gap_at(const BorderEdge& edge) const {
    Gap gap{edge, 0, -1, {}, 0};
    for (const Edge& part : edge.open) add_part(gap, places_[part[0]], places_[part[1]]);
    if (gap.largest < 0) return std::nullopt;
    return gap;
}

std::optional<GapDistances::Near> GapDistances::nearest(const Point3& p,
                                                        const BorderEdge& edge) const {
    std::optional<Near> best;
    double bound = bound_;
    for (std::uint32_t s = 0; s < trees_.size(); ++s) {
        if (std::binary_search(edge.own.begin(), edge.own.end(), s)) continue;
        if (const auto near = trees_[s].nearest(p, bound)) {
            best = Near{near->place, s};
            bound = near->distance;
        }
    }
    return best;
}

void GapDistances::add_part(Gap& gap, const Point3& p, const Point3& q) const {
    double largest = -1;
    Near nearest_there;
    Point3 place{};
    for (const Point3& at : {p, middle(p, q), q}) {
        const auto near = nearest(at, gap.edge);
        if (!near) return;
        const double d = length(minus(near->place, at));
        if (d <= largest) continue;
        largest = d;
        place = at;
        nearest_there = *near;
    }
    gap.length += length(minus(q, p));
    if (largest <= gap.largest) return;
    gap.largest = largest;
    gap.place = place;
    gap.to = nearest_there.surface;
}

} // namespace terrane::sealing::detail
