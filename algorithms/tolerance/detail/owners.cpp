// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tolerance/detail/owners.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/tolerance/detail/tuning.hpp>

namespace terrane::tolerance::detail {
namespace {

/// Finds the pieces in which points are.
class Locator {
public:
    explicit Locator(const Pieces& pieces) : pieces_(pieces) {
        for (std::uint32_t t = 0; t < pieces.triangles.size(); ++t)
            for (const std::uint32_t p : pieces.parents_of[t]) of_input_[p].push_back(t);
    }
    /// Returns the piece of an input triangle where a point is, or nearly.
    [[nodiscard]] std::uint32_t piece_at(std::uint32_t input, const Point3& p) const {
        const auto& all = of_input_.at(input);
        if (all.size() == 1) return all[0];
        return *std::ranges::max_element(all, {}, [&](std::uint32_t t) { return depth(p, t); });
    }

private:
    /// Returns the least barycentric coordinate of a point in a triangle.
    [[nodiscard]] double depth(const Point3& p, std::uint32_t t) const {
        const auto& c = pieces_.triangles[t];
        const Point3 &a = pieces_.places[c[0]], &b = pieces_.places[c[1]],
                     &d = pieces_.places[c[2]];
        const Point3 n = cross(minus(b, a), minus(d, a));
        const auto part = [&](const Point3& q, const Point3& r) {
            return dot(cross(minus(q, p), minus(r, p)), n);
        };
        const double square = dot(n, n);
        return square > 0 ? std::min({part(a, b), part(b, d), part(d, a)}) / square
                          : -std::numeric_limits<double>::infinity();
    }

    const Pieces& pieces_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> of_input_;
};

/// Pieces that have the same owners.
struct Region {
    double width = -1;        ///< of the widest piece
    std::uint32_t widest = 0; ///< piece
    bool is_known = false;
    std::vector<Owner> owners{}; ///< relative to the orientation of its pieces
};

class Finding {
public:
    Finding(const Pieces& pieces, const std::vector<bool>& closed, const Run& run) :
        pieces_(pieces), closed_(closed),
        edges_(group_edges(pieces.triangles, pieces.places.size(), run)),
        sets_(pieces.triangles.size()), regions_(pieces.triangles.size()) {
        edges_.for_each([&](std::uint32_t, std::uint32_t, std::span<const EdgeSides::Side> sides) {
            if (sides.size() == 2 && std::ranges::equal(pieces.parents_of[sides[0].triangle],
                                                        pieces.parents_of[sides[1].triangle]))
                sets_.join(sides[0].triangle, sides[1].triangle);
        });
        for (std::uint32_t t = 0; t < regions_.size(); ++t) {
            Region& region = regions_[sets_.find(t)];
            if (const double w = width_of(t); w > region.width) {
                region.width = w;
                region.widest = t;
            }
        }
    }

    /// locate(piece) returns the owners of a piece by its place.
    template <class Locate>
    Owners operator()(const Locate& locate) {
        std::vector<std::uint32_t> narrow; // regions
        for (std::uint32_t t = 0; t < regions_.size(); ++t) {
            if (sets_.find(t) != t) continue;
            Region& region = regions_[t];
            region.owners = locate(region.widest);
            region.is_known = region.width > least_width(region.widest);
            if (!region.is_known) narrow.push_back(t);
        }
        std::ranges::stable_sort(narrow, {}, [&](std::uint32_t r) { return regions_[r].width; });
        list_edges();
        for (std::uint32_t e = 0; e < narrow_edges_.size(); ++e) todo_.push_back(e);
        propagate();
        for (; !narrow.empty(); narrow.pop_back()) // the widest is the most likely to be right
            if (Region& region = regions_[narrow.back()]; !region.is_known) {
                region.is_known = true;
                todo_ = edges_of_[narrow.back()];
                propagate();
            }
        Owners owners(regions_.size());
        for (std::uint32_t t = 0; t < owners.size(); ++t)
            owners[t] = regions_[sets_.find(t)].owners;
        return owners;
    }

private:
    struct Place { ///< a piece at an edge
        std::uint32_t piece;
        bool runs_along;
    };

    [[nodiscard]] double width_of(std::uint32_t t) const {
        const auto& [i, j, k] = pieces_.triangles[t];
        const Point3 &a = pieces_.places[i], &b = pieces_.places[j], &c = pieces_.places[k];
        const double longest =
            std::max({length_between(a, b), length_between(b, c), length_between(c, a)});
        return longest > 0 ? area_between(a, b, c) / longest : 0;
    }
    [[nodiscard]] double least_width(std::uint32_t t) const {
        const Point3& p = pieces_.places[pieces_.triangles[t][0]];
        return tuning.located_spacings * std::numeric_limits<double>::epsilon() *
               std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    void list_edges() {
        edges_.for_each(
            [&](std::uint32_t low, std::uint32_t, std::span<const EdgeSides::Side> sides) {
                std::vector<Place> at;
                bool is_narrow = false;
                for (const auto& side : sides) {
                    at.push_back({side.triangle,
                                  runs_along(pieces_.triangles[side.triangle], low, side.high)});
                    is_narrow = is_narrow || !region_of(side.triangle).is_known;
                }
                if (!is_narrow || sides.size() < 2) return;
                for (const Place& p : at)
                    edges_of_[sets_.find(p.piece)].push_back(
                        static_cast<std::uint32_t>(narrow_edges_.size()));
                narrow_edges_.push_back(std::move(at));
            });
    }
    [[nodiscard]] Region& region_of(std::uint32_t piece) { return regions_[sets_.find(piece)]; }

    /// Closed surfaces have an even number of pieces at an edge: the last region that is unknown follows.
    void propagate() {
        while (!todo_.empty()) {
            const auto& at = narrow_edges_[todo_.back()];
            todo_.pop_back();
            const Place* last = nullptr;
            std::size_t unknown = 0;
            for (const Place& p : at)
                if (!region_of(p.piece).is_known) {
                    ++unknown;
                    last = &p;
                }
            if (unknown != 1) continue;
            Region& region = region_of(last->piece);
            std::erase_if(region.owners, [&](const Owner& o) { return closed_[o.surface]; });
            for (const Place& p : at) {
                if (&p == last) continue;
                for (const Owner& o : region_of(p.piece).owners) {
                    if (!closed_[o.surface]) continue;
                    if (std::erase_if(region.owners,
                                      [&](const Owner& q) { return q.surface == o.surface; }) == 0)
                        // Both sides of the surface run along the edge in opposite directions.
                        region.owners.push_back(
                            {o.surface, last->runs_along == (p.runs_along != o.is_reversed)});
                }
            }
            std::ranges::sort(region.owners, {}, &Owner::surface);
            region.is_known = true;
            const auto& next = edges_of_[sets_.find(last->piece)];
            todo_.insert(todo_.end(), next.begin(), next.end());
        }
    }

    const Pieces& pieces_;
    const std::vector<bool>& closed_;
    const EdgeSides edges_;
    DisjointSets sets_;
    std::vector<Region> regions_; ///< by their first piece
    std::vector<std::vector<Place>> narrow_edges_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> edges_of_; ///< per region
    std::vector<std::uint32_t> todo_;                              ///< of narrow_edges_
};

} // namespace

Owners owners_of(const Pieces& pieces, const Pieces& before, const Owners& owners_before,
                 const std::vector<bool>& closed,
                 const std::function<std::uint32_t(std::uint32_t)>& given, const Run& run) {
    const Locator locator(before);
    return Finding(pieces, closed, run)([&](std::uint32_t t) {
        const auto& [i, j, k] = pieces.triangles[t];
        const Point3 centre = centre_of(pieces.places[i], pieces.places[j], pieces.places[k]);
        return owners_before[locator.piece_at(given(pieces.parents_of[t][0]), centre)];
    });
}

bool are_closed(const Pieces& pieces, const Owners& owners, const std::vector<bool>& closed,
                const Run& run) {
    bool all = true;
    group_edges(pieces.triangles, pieces.places.size(), run)
        .for_each([&](std::uint32_t, std::uint32_t, std::span<const EdgeSides::Side> sides) {
            std::vector<std::uint32_t> odd;
            for (const auto& side : sides)
                for (const Owner& o : owners[side.triangle])
                    if (std::erase(odd, o.surface) == 0) odd.push_back(o.surface);
            all = all && std::ranges::none_of(odd, [&](std::uint32_t s) { return closed[s]; });
        });
    return all;
}

} // namespace terrane::tolerance::detail
