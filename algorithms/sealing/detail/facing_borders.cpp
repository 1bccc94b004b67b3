// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/detail/facing_borders.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sealing/detail/constants.hpp>

namespace terrane::sealing::detail {
namespace {

/// Measured distances of points computed from others are off by some roundings.
constexpr double rounding = 1e-9;

Point3 between(const Point3& p, const Point3& q, double share) {
    return {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y), p.z + share * (q.z - p.z)};
}

std::vector<Point3> ends_of(const Arrangement& a, std::span<const BorderEdge> edges) {
    std::vector<Point3> places;
    for (const BorderEdge& e : edges)
        for (const std::uint32_t v : {e.from, e.to}) places.push_back(a.state->points.input(v));
    return places;
}

/// Makes a degenerate triangle of each edge.
std::vector<Triangle> as_triangles(std::size_t edges) {
    std::vector<Triangle> triangles;
    for (std::uint32_t e = 0; e < edges; ++e) triangles.push_back({2 * e, 2 * e + 1, 2 * e + 1});
    return triangles;
}

} // namespace

FacingBorders::FacingBorders(const Arrangement& a, std::vector<BorderEdge> edges,
                             const SealDistances& distances, const GapDistances& gaps) :
    edges_(std::move(edges)),
    distances_(distances), gaps_(gaps), places_(ends_of(a, edges_)),
    tree_(places_, as_triangles(edges_.size())) {
    for (const BorderEdge& e : edges_) outward_.push_back(outward_of(a, e));
}

std::optional<FacingBorders::Facing> FacingBorders::facing(std::uint32_t edge) const {
    const std::uint32_t surface = edges_[edge].surface;
    const Point3 p = middle_of(edge);
    const auto key = [&](std::uint32_t e) {
        const Point3 &a = places_[2 * std::size_t{e}], &b = places_[2 * std::size_t{e} + 1];
        return std::array{std::min(a, b), std::max(a, b)};
    };
    std::optional<Facing> best;
    for (const auto& near : tree_.within(p, std::nextafter(distances_.largest(), HUGE_VAL))) {
        const std::uint32_t other = near.triangle[0] / 2;
        const double least = constants.least_beside * near.distance;
        const Point3 way = minus(near.place, p);
        if (other == edge || near.distance == 0 ||
            near.distance > distances_.between(surface, edges_[other].surface) ||
            -dot(outward_[edge], outward_[other]) < constants.least_facing ||
            dot(outward_[edge], way) < least || -dot(outward_[other], way) < least)
            continue;
        if (!best || near.distance < best->distance ||
            (near.distance == best->distance && key(other) < key(best->edge)))
            best = Facing{other, near.distance, p};
    }
    if (!best) return best;
    const bool is_parted = std::ranges::all_of(std::array{0.0, 0.5, 1.0}, [&](double share) {
        const Point3 at =
            between(places_[2 * std::size_t{edge}], places_[2 * std::size_t{edge} + 1], share);
        return gaps_.is_any_ahead(at, edges_[edge], edges_[best->edge].surface, best->distance);
    });
    return is_parted ? std::nullopt : best;
}

bool FacingBorders::is_in_gap(const Point3& p, const Point3& q, std::uint32_t surface,
                              std::uint32_t other) const {
    const double most = distances_.between(surface, other) / 2 * (1 + rounding);
    return std::ranges::all_of(std::array{0.25, 0.5, 0.75}, [&](double share) {
        return std::ranges::any_of(tree_.within(between(p, q, share), most), [&](const auto& near) {
            const std::uint32_t s = edges_[near.triangle[0] / 2].surface;
            return s == surface || s == other;
        });
    });
}

bool FacingBorders::is_border_nearest(const Point3& p, std::uint32_t surface, double distance,
                                      const BorderEdge& except) const {
    const double most = std::nextafter(distance * (1 + rounding), HUGE_VAL);
    return std::ranges::any_of(tree_.within(p, most), [&](const auto& near) {
        const BorderEdge& e = edges_[near.triangle[0] / 2];
        return e.surface == surface && (e.from != except.from || e.to != except.to) &&
               near.distance >= distance * (1 - rounding);
    });
}

Point3 FacingBorders::middle_of(std::uint32_t edge) const {
    return between(places_[2 * std::size_t{edge}], places_[2 * std::size_t{edge} + 1], 0.5);
}

double FacingBorders::length_of(std::uint32_t edge) const {
    return length(minus(places_[2 * std::size_t{edge} + 1], places_[2 * std::size_t{edge}]));
}

} // namespace terrane::sealing::detail
