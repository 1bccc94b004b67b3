// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/target.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/selection/windings.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::judging {
namespace {

/// Returns the normal of a triangle, twice as long as its area.
Point3 normal_of(const Point3& a, const Point3& b, const Point3& c) {
    return cross(minus(b, a), minus(c, a));
}

class CellFinder {
public:
    explicit CellFinder(const Target& target) :
        target_(target), exact_(target.exact), points_(target.exact.state->points),
        sets_(target.triangles.size()) {}

    Cells operator()() {
        const EdgeSides edges = group_edges(target_.triangles, exact_.vertices.size());
        std::vector<std::array<std::uint32_t, 3>> open; // triangle, from, to
        edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (sides.size() == 2 && joined(sides[0].triangle, sides[1].triangle, {low, high})) {
                sets_.join(sides[0].triangle, sides[1].triangle);
                return;
            }
            cells_.edges.push_back({low, high});
            if (sides.size() == 1) cells_.borders.push_back({low, high});
            for (const auto& s : sides) {
                const bool along = runs_along(target_.triangles[s.triangle], low, high);
                open.push_back({s.triangle, along ? low : high, along ? high : low});
            }
        });
        number_cells();
        for (const auto& [triangle, from, to] : open)
            cells_.boundary.push_back({cell_of_[triangle], from, to});
        std::ranges::set_intersection(cells_.edges, exact_.intersection_edges,
                                      std::back_inserter(cells_.curves));
        list_at_vertices();
        return std::move(cells_);
    }

private:
    [[nodiscard]] auto parents(std::uint32_t t) const {
        return exact_.parents_of[target_.source[t]];
    }
    [[nodiscard]] const Triangle& plane(std::uint32_t t) const {
        return exact_.input_corners()[parents(t)[0]];
    }

    [[nodiscard]] bool joined(std::uint32_t s, std::uint32_t t, const Edge& edge) const {
        const auto [low, high] = edge;
        if (runs_along(target_.triangles[s], low, high) ==
            runs_along(target_.triangles[t], low, high))
            return false;
        if (!target_.solid) {
            const auto& surfaces = exact_.surfaces_of;
            if (parents(s).size() != parents(t).size() ||
                !std::ranges::equal(surfaces[target_.source[s]], surfaces[target_.source[t]]) ||
                std::ranges::binary_search(exact_.intersection_edges, edge))
                return false;
        }
        if (parents(s)[0] == parents(t)[0]) return true;
        const Triangle &p = plane(s), &q = plane(t);
        return std::ranges::all_of(q, [&](std::uint32_t corner) {
            return orient3d(input(p[0]), input(p[1]), input(p[2]), input(corner)) == Sign::Zero;
        });
    }
    [[nodiscard]] const Point3& input(std::uint32_t p) const { return points_.input(p); }

    void number_cells() {
        const UpwardRounding upward;
        cell_of_.assign(target_.triangles.size(), no_index);
        for (std::uint32_t t = 0; t < target_.triangles.size(); ++t) {
            const std::uint32_t first = sets_.find(t);
            if (first == t) {
                cell_of_[t] = static_cast<std::uint32_t>(cells_.cells.size());
                cells_.cells.push_back(cell(upward, t));
            }
            cell_of_[t] = cell_of_[first];
            Cell& c = cells_.cells[cell_of_[t]];
            const Triangle& corners = target_.triangles[t];
            c.area += length(normal_of(exact_.nearest(VertexId(corners[0])),
                                       exact_.nearest(VertexId(corners[1])),
                                       exact_.nearest(VertexId(corners[2])))) /
                      2;
            if (target_.solid) continue;
            for (const std::uint32_t p : parents(t))
                c.either = c.either || turn_of(exact_, p, c.axis) != c.turn;
        }
    }

    [[nodiscard]] Cell cell(UpwardWitness upward, std::uint32_t t) const {
        Cell c;
        c.triangle = t;
        c.plane = plane(t);
        c.axis = projection_axis(input(c.plane[0]), input(c.plane[1]), input(c.plane[2]));
        const Triangle& corners = target_.triangles[t];
        c.turn = points_.orient2d(upward, c.axis, exact_.vertices[corners[0]],
                                  exact_.vertices[corners[1]], exact_.vertices[corners[2]]);
        const Point3 n = normal_of(input(c.plane[0]), input(c.plane[1]), input(c.plane[2]));
        const bool same = turn_of(exact_, parents(t)[0], c.axis) == c.turn;
        if (const double l = same ? length(n) : -length(n); l != 0)
            c.normal = {n.x / l, n.y / l, n.z / l};
        if (!target_.solid) c.parents = static_cast<std::uint32_t>(parents(t).size());
        return c;
    }

    void list_at_vertices() {
        std::vector<std::array<std::uint32_t, 2>> pairs;
        pairs.reserve(3 * target_.triangles.size());
        for (std::uint32_t t = 0; t < target_.triangles.size(); ++t)
            for (const std::uint32_t v : target_.triangles[t]) pairs.push_back({v, cell_of_[t]});
        sort_unique(pairs);
        std::size_t i = 0;
        for (std::uint32_t v = 0; v < exact_.vertices.size(); ++v) {
            for (; i < pairs.size() && pairs[i][0] == v; ++i)
                cells_.at_vertex.values.push_back(pairs[i][1]);
            cells_.at_vertex.close();
        }
    }

    const Target& target_;
    const Arrangement& exact_;
    const PointStore& points_;
    DisjointSets sets_;
    std::vector<std::uint32_t> cell_of_; ///< per triangle
    Cells cells_;
};

/// Largest coordinate and extent of what has area.
struct Size {
    double largest = 0; ///< absolute coordinate
    double extent = 0;  ///< diagonal of the bounding box
};

Size size_of(const Arrangement& exact) {
    Size size;
    Point3 low, high;
    for (std::uint32_t v = 0; v < exact.vertices.size(); ++v) {
        const Point3& p = exact.nearest(VertexId(v));
        if (v == 0) low = high = p;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        size.largest = std::max({size.largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    size.extent = length(minus(high, low));
    return size;
}

/// Judges nothing where the bound is more than this share of the extent: nearly all would be in doubt.
constexpr double most_of_extent = 0x1p-12;

} // namespace

Status check_options(const JudgeOptions& options) {
    if (options.spacings >= 0 && options.spacings <= 0x1p40) return Done{};
    return Error{ErrorCode::bad_option, "must be from 0 to 2^40", "spacings"};
}

Result<Bound> bound_of(const Arrangement& exact, double spacings) {
    const auto [largest, extent] = size_of(exact);
    if (largest > 0x1p250 || (largest > 0 && largest < 0x1p-250)) // squares of areas are no doubles
        return Error{ErrorCode::unsupported, "the largest coordinate must be from 1e-75 to 1e75",
                     "inputs"};
    const double spacing =
        std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
    const double bound = spacings * spacing;
    if (extent > 0 && bound > most_of_extent * extent)
        return Error{ErrorCode::unsupported,
                     "the bound " + figure(bound) + " is more than a 4096th of the inputs' extent",
                     "spacings"};
    return Bound{bound, std::max(bound, spacing / 4), most_of_extent * extent, {}};
}

Target whole_arrangement(const Arrangement& exact) {
    Target target{exact, exact.triangles, std::vector<std::uint32_t>(exact.triangles.size())};
    std::iota(target.source.begin(), target.source.end(), 0U);
    return target;
}

Cells find_cells(const Target& target) {
    return CellFinder(target)();
}

} // namespace terrane::judging
