// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/detail/oriented.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/selection/windings.hpp>
#include <terrane/algorithms/volumes/exact_volumes.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::selection {
namespace {

/// Returns the mean of three points, whatever their order.
Point3 middle_of(std::array<Point3, 3> p) {
    std::sort(p.begin(), p.end());
    return {(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3,
            (p[0].z + p[1].z + p[2].z) / 3};
}

std::array<Point3, 3> corners_of(const Mesh& mesh, std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// What the facets say of the volumes of a rounded boundary.
class Ballot {
public:
    Ballot(const Mesh& rounded, const Volumes& volumes, const BoundaryFacets& facets) :
        volumes_(volumes), balance_(volumes.measures.size()) {
        for (std::size_t t = 0; t < rounded.triangles.size(); ++t) {
            const auto* facet = facets.nearest(rounded.parents_of[t][0], corners_of(rounded, t));
            if (facet == nullptr || volumes.dangles(t)) continue;
            const auto& sides = volumes.of_sides[t];
            ++balance_[sides[facet->is_behind ? 1 : 0]];
            --balance_[sides[facet->is_behind ? 0 : 1]];
            pieces_.emplace_back(sides[facet->is_behind ? 1 : 0], facet->piece);
        }
    }

    /// Whether each volume is in the region; the outside never is.
    [[nodiscard]] std::vector<bool> inside() const {
        std::vector<bool> in;
        for (const auto sum : balance_) in.push_back(!in.empty() && sum > 0);
        return in;
    }

    /// Returns the piece of each volume that is inside: of volumes that are connected, the one that most
    /// facets have.
    [[nodiscard]] std::vector<std::uint32_t> pieces(const std::vector<bool>& inside) {
        DisjointSets joined(inside.size());
        for (const auto& [front, behind] : volumes_.of_sides)
            if (inside[front] && inside[behind]) joined.join(front, behind);
        for (auto& [volume, piece] : pieces_) volume = joined.find(volume);
        std::sort(pieces_.begin(), pieces_.end());
        std::vector<std::uint32_t> piece(inside.size(), 0);
        std::vector<std::size_t> most(inside.size(), 0);
        for (std::size_t i = 0, end = 0; i < pieces_.size(); i = end) {
            while (end < pieces_.size() && pieces_[end] == pieces_[i]) ++end;
            const auto [volume, named] = pieces_[i];
            if (end - i > most[volume])
                std::tie(most[volume], piece[volume]) = std::pair(end - i, named);
        }
        for (std::uint32_t v = 0; v < piece.size(); ++v) piece[v] = piece[joined.find(v)];
        return piece;
    }

private:
    const Volumes& volumes_;
    std::vector<std::int64_t>
        balance_; ///< per volume: facets with the region there, minus the others
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pieces_; ///< {volume, piece} per facet
};

} // namespace

BoundaryFacets::BoundaryFacets(const SelectedRegion& region) :
    of_parent_(region.boundary.input_corners().size()) {
    const Arrangement& a = region.boundary;
    const auto facet = [&](std::size_t t) -> Facet {
        const auto [front, behind] = region.of_sides[t];
        return {a.parents_of[t][0], {}, std::max(front, behind) - 1, behind != 0};
    };
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        const Facet own = facet(t);
        OfParent& first = of_parent_[own.parent];
        if (!first.is_known)
            first = {own, true, false};
        else if (own.piece != first.facet.piece || own.is_behind != first.facet.is_behind)
            first.is_mixed = true;
    }
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        if (!of_parent_[a.parents_of[t][0]].is_mixed) continue;
        const auto at = [&](unsigned i) { return a.nearest(VertexId(a.triangles[t][i])); };
        mixed_.push_back(facet(t));
        mixed_.back().middle = middle_of({at(0), at(1), at(2)});
    }
    std::sort(mixed_.begin(), mixed_.end(), [](const Facet& f, const Facet& g) {
        return std::tie(f.parent, f.middle) < std::tie(g.parent, g.middle);
    });
}

const BoundaryFacets::Facet* BoundaryFacets::nearest(std::uint32_t parent,
                                                     const std::array<Point3, 3>& corners) const {
    const OfParent& known = of_parent_[parent];
    if (!known.is_known) return nullptr;
    if (!known.is_mixed) return &known.facet;
    const Point3 middle = middle_of(corners);
    const auto first = std::ranges::lower_bound(mixed_, parent, {}, &Facet::parent);
    const auto last = std::ranges::upper_bound(mixed_, parent, {}, &Facet::parent);
    const auto same = std::lower_bound(
        first, last, middle, [](const Facet& f, const Point3& p) { return f.middle < p; });
    if (same != last && same->middle == middle) return &*same;
    const auto distance = [&](const Facet& f) {
        const Point3 d = minus(f.middle, middle);
        return dot(d, d);
    };
    return &*std::min_element(
        first, last, [&](const Facet& f, const Facet& g) { return distance(f) < distance(g); });
}

namespace {

/// Whether the triangles of a region's boundary are connected through edges of two of them, and have no other edges.
bool is_one_surface(const Arrangement& boundary) {
    const Adjacency& adjacency = boundary.state->adjacency;
    DisjointSets parts(boundary.triangles.size());
    for (const auto& inner : adjacency.inner)
        for (const auto& [t, u] : inner) parts.join(t, u);
    for (std::size_t e = 0; e < adjacency.edges.size(); ++e) {
        const auto at = adjacency.triangles_at[e];
        if (at.size() != 2) return false;
        parts.join(at[0], at[1]);
    }
    const auto& first = parts.flattened();
    return std::ranges::all_of(first, [](std::uint32_t t) { return t == 0; });
}

/// Whether triangles that face outwards, if those are turned whose back is not in the region, enclose a positive
/// volume, as far as doubles tell.
bool enclose_volume(const Mesh& mesh, const SelectedRegion& region) {
    const Point3 origin = mesh.vertices[mesh.triangles[0][0]];
    double sum = 0, most = 0; // of six volumes; of their sizes, for the bound of the error
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [p, q, r] = corners_of(mesh, t);
        const double left = (q.x - p.x) * (r.y - p.y), right = (q.y - p.y) * (r.x - p.x);
        const double a = p.z - origin.z, b = q.z - origin.z, c = r.z - origin.z;
        const double below = (left - right) * (a + b + c);
        sum += region.of_sides[t][1] != 0 ? below : -below;
        most += (std::fabs(left) + std::fabs(right)) * (std::fabs(a) + std::fabs(b) + std::fabs(c));
    }
    // Each term has an error of less than 16 units of its size, each sum of one unit; twice that in any rounding mode.
    const double terms = 32 + 2 * static_cast<double>(mesh.triangles.size());
    return sum > terms * std::numeric_limits<double>::epsilon() * most && sum > 1e-250;
}

/// Turns the triangles outwards where they are one surface. It has two sides, which its edges tell, as they have two
/// triangles each; that to the region is the inner one if it encloses a positive volume. Else returns nothing.
std::optional<Oriented> oriented_as_exact(Mesh& rounded, const SelectedRegion& region) {
    if (rounded.triangles.empty() || rounded.triangles != region.boundary.triangles ||
        rounded.parents_of != region.boundary.parents_of || !is_one_surface(region.boundary) ||
        !enclose_volume(rounded, region))
        return std::nullopt;
    Oriented made;
    for (std::size_t t = 0; t < rounded.triangles.size(); ++t) {
        const auto [front, behind] = region.of_sides[t];
        if (front != 0) std::swap(rounded.triangles[t][1], rounded.triangles[t][2]);
        made.piece_of.push_back(std::max(front, behind) - 1);
    }
    rounded.regions_of = {};
    made.mesh = std::move(rounded);
    return made;
}

} // namespace

Result<Oriented> oriented(const RoundedMesh& found, const SelectedRegion& region, const Run& run) {
    Mesh rounded = *found.mesh;
    if (found.report.clean)
        if (auto made = oriented_as_exact(rounded, region)) return std::move(*made);
    const auto volumes = volumes::find_sides(rounded, run);
    if (!volumes) return volumes.error();
    Ballot ballot(rounded, *volumes, BoundaryFacets(region));
    const auto inside = ballot.inside();
    const auto piece = ballot.pieces(inside);
    Oriented made;
    std::vector<bool> keep;
    for (std::size_t t = 0; t < rounded.triangles.size(); ++t) {
        const auto [front, behind] = volumes->of_sides[t];
        keep.push_back(inside[front] != inside[behind]);
        if (!keep.back()) continue;
        if (inside[front]) std::swap(rounded.triangles[t][1], rounded.triangles[t][2]);
        made.piece_of.push_back(piece[inside[front] ? front : behind]);
    }
    rounded.regions_of = {};
    const bool is_all = made.piece_of.size() == keep.size();
    made.mesh = is_all ? std::move(rounded) : part_of(rounded, keep);
    return made;
}

void turn_as_open(const SelectedRegion& region, Mesh& rounded) {
    const Arrangement& a = region.boundary;
    const PointStore& points = a.state->points;
    for (std::size_t t = 0; t < rounded.triangles.size(); ++t) {
        const auto parents = rounded.parents_of[t];
        const auto own = std::ranges::find_if(parents, [&](std::uint32_t p) {
            return region.open[a.inputs.surface_of(InputTriangleId(p))];
        });
        if (own == parents.begin() || own == parents.end()) continue;
        const Triangle& c = a.input_corners()[*own];
        const Axis axis =
            projection_axis(points.input(c[0]), points.input(c[1]), points.input(c[2]));
        if (turn_of(a, *own, axis) != turn_of(a, parents[0], axis))
            std::swap(rounded.triangles[t][1], rounded.triangles[t][2]);
    }
}

Mesh part_of(const Mesh& mesh, const std::vector<bool>& keep) {
    Mesh part{mesh.surfaces, mesh.vertices, {}, {}, {}, {}, {}};
    std::vector<Edge> edges;
    for (std::size_t t = 0; t < keep.size(); ++t) {
        if (!keep[t]) continue;
        const Triangle& c = mesh.triangles[t];
        part.triangles.push_back(c);
        part.surfaces_of.push_back(mesh.surfaces_of[t]);
        part.parents_of.push_back(mesh.parents_of[t]);
        for (unsigned i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(c[i], c[(i + 1) % 3]);
            edges.push_back({low, high});
        };
    }
    sort_unique(edges);
    std::set_intersection(mesh.intersection_edges.begin(), mesh.intersection_edges.end(),
                          edges.begin(), edges.end(), std::back_inserter(part.intersection_edges));
    const VertexRenumbering numbers(used_vertices(part.vertices.size(), part.triangles));
    numbers.compact(part.vertices);
    numbers.rename(part.triangles);
    numbers.rename(part.intersection_edges);
    return part;
}

} // namespace terrane::selection
