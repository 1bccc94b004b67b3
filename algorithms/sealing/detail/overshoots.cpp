// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/detail/overshoots.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>
#include <terrane/algorithms/sealing/detail/constants.hpp>

namespace terrane::sealing::detail {
namespace {

constexpr int samples = static_cast<int>(constants.overshoot_samples);

class Finder {
public:
    Finder(const Arrangement& a, const SealDistances& distances) : a_(a), distances_(distances) {
        for (const PointIndex v : a.vertices) places_.push_back(a.state->points.nearest(v));
        regions_ = find_regions(places_, a.triangles, a.surfaces_of, a.state->adjacency,
                                a.intersection_edges);
    }

    std::vector<Overshoot> operator()() {
        collect();
        std::map<std::uint32_t, Overshoot> found;
        for (auto& [r, region] : candidates_)
            if (auto shoot = measure(r, region)) found.emplace(r, std::move(*shoot));
        keep_what_goes_on(found);
        keep_what_others_end_on(found);
        std::vector<Overshoot> all;
        for (auto& [r, shoot] : found) all.push_back(std::move(shoot));
        return all;
    }

private:
    struct Candidate {
        std::vector<std::uint32_t> triangles{}; ///< ascending
        /// Edges as degenerate triangles, by the distance for the surfaces there.
        std::map<double, std::vector<Triangle>> curves{};
        double border = 0;
        std::set<std::uint32_t> beyond{}; ///< regions of the same surface across the curve
    };

    /// Returns the region of a triangle that is in one surface only, otherwise none.
    [[nodiscard]] std::uint32_t region_of(std::uint32_t t) const {
        const auto of = regions_.regions_of[t];
        return of.size() == 1 ? of[0] : no_index;
    }

    void collect() {
        for (std::size_t e = 0; e < a_.state->adjacency.edges.size(); ++e) {
            const auto at = a_.state->adjacency.triangles_at[e];
            if (at.size() != 1 || region_of(at[0]) == no_index) continue;
            const auto& [v, w] = a_.state->adjacency.edges[e];
            candidates_[region_of(at[0])].border += length(minus(places_[v], places_[w]));
        }
        for (std::uint32_t t = 0; t < a_.triangles.size(); ++t)
            for (const std::uint32_t r : regions_.regions_of[t]) {
                const auto it = candidates_.find(r);
                if (it == candidates_.end()) continue;
                if (region_of(t) == no_index)
                    candidates_.erase(it); // partly in several surfaces
                else
                    it->second.triangles.push_back(t);
            }
        for (std::size_t e = 0; e < a_.state->adjacency.edges.size(); ++e) {
            const Edge& edge = a_.state->adjacency.edges[e];
            const auto at = a_.state->adjacency.triangles_at[e];
            if (!std::binary_search(a_.intersection_edges.begin(), a_.intersection_edges.end(),
                                    edge))
                continue;
            for (const std::uint32_t t : at) {
                const auto it = candidates_.find(region_of(t));
                if (it == candidates_.end()) continue;
                if (const double distance = distance_at(at, a_.surfaces_of[t][0]); distance > 0)
                    it->second.curves[distance].push_back({edge[0], edge[1], edge[1]});
                for (const std::uint32_t u : at) add_beyond(it->second, t, u);
            }
        }
        std::erase_if(candidates_, [](const auto& c) {
            return c.second.beyond.empty() || c.second.curves.empty();
        });
    }

    /// Returns the largest distance for a surface and another one that has a triangle at an edge;
    /// for parts of the surface where there is no other.
    [[nodiscard]] double distance_at(std::span<const std::uint32_t> at,
                                     std::uint32_t surface) const {
        double largest = 0;
        bool any = false;
        for (const std::uint32_t t : at)
            for (const std::uint32_t s : a_.surfaces_of[t]) {
                if (s == surface) continue;
                any = true;
                largest = std::max(largest, distances_.between(surface, s));
            }
        return any ? largest : distances_.between(surface, surface);
    }

    void add_beyond(Candidate& candidate, std::uint32_t t, std::uint32_t u) const {
        const std::uint32_t surface = a_.surfaces_of[t][0];
        for (std::size_t i = 0; i < a_.surfaces_of[u].size(); ++i)
            if (a_.surfaces_of[u][i] == surface && regions_.regions_of[u][i] != region_of(t))
                candidate.beyond.insert(regions_.regions_of[u][i]);
    }

    /// Measures a candidate. Returns nothing if some point is too far from the curve.
    [[nodiscard]] std::optional<Overshoot> measure(std::uint32_t r, Candidate& c) const {
        std::vector<Curve> curves;
        for (auto& [distance, edges] : c.curves)
            curves.push_back(
                {TriangleTree(places_, std::move(edges)), std::nextafter(distance, HUGE_VAL)});
        Overshoot shoot{regions_.regions[r].surface, c.triangles, c.border, -1, {}};
        for (const std::uint32_t t : c.triangles)
            for (const std::uint32_t v : a_.triangles[t]) {
                const double d = distance_from(curves, places_[v]);
                if (d == HUGE_VAL) return std::nullopt;
                if (d <= shoot.largest) continue;
                shoot.largest = d;
                shoot.place = places_[v];
            }
        for (const std::uint32_t t : c.triangles)
            if (!is_near(t, curves)) return std::nullopt;
        return shoot;
    }

    /// A part of a curve, and the distance within which points near it may be removed.
    struct Curve {
        TriangleTree edges;
        double bound;
    };

    /// Returns the distance from the nearest curve within whose bound a point is, or infinity.
    static double distance_from(const std::vector<Curve>& curves, const Point3& p) {
        double least = HUGE_VAL;
        for (const Curve& curve : curves)
            if (const double d = curve.edges.distance(p, curve.bound); d < curve.bound)
                least = std::min(least, d);
        return least;
    }

    [[nodiscard]] bool is_near(std::uint32_t t, const std::vector<Curve>& curves) const {
        const auto [i, j, k] = a_.triangles[t];
        const Point3 &p = places_[i], u = minus(places_[j], p), v = minus(places_[k], p);
        for (int m = 0; m <= samples; ++m)
            for (int n = 0; m + n <= samples; ++n) {
                const double s = double(m) / samples, f = double(n) / samples;
                const Point3 q{p.x + s * u.x + f * v.x, p.y + s * u.y + f * v.y,
                               p.z + s * u.z + f * v.z};
                if (distance_from(curves, q) == HUGE_VAL) return false;
            }
        return true;
    }

    /// Keeps surfaces all of whose regions are near curves: a region is an overshoot only if one
    /// that it continues remains.
    void keep_what_goes_on(std::map<std::uint32_t, Overshoot>& found) const {
        std::vector<std::uint32_t> alone;
        for (const auto& [r, shoot] : found) {
            const auto& beyond = candidates_.at(r).beyond;
            if (std::all_of(beyond.begin(), beyond.end(),
                            [&](std::uint32_t q) { return found.contains(q); }))
                alone.push_back(r);
        }
        for (const std::uint32_t r : alone) found.erase(r);
    }

    /// Keeps regions without which an edge would have a single triangle.
    void keep_what_others_end_on(std::map<std::uint32_t, Overshoot>& found) const {
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t e = 0; e < a_.state->adjacency.edges.size(); ++e) {
                const auto at = a_.state->adjacency.triangles_at[e];
                const auto goes = [&](std::uint32_t t) { return found.contains(region_of(t)); };
                const auto left = static_cast<std::size_t>(
                    std::count_if(at.begin(), at.end(), [&](auto t) { return !goes(t); }));
                if (left != 1 || at.size() == 1) continue;
                for (const std::uint32_t t : at) changed = found.erase(region_of(t)) > 0 || changed;
            }
        }
    }

    const Arrangement& a_;
    const SealDistances& distances_;
    std::vector<Point3> places_;
    Regions regions_;
    std::map<std::uint32_t, Candidate> candidates_; ///< by region
};

} // namespace

std::vector<Overshoot> find_overshoots(const Arrangement& arrangement,
                                       const SealDistances& distances) {
    return Finder(arrangement, distances)();
}

} // namespace terrane::sealing::detail
