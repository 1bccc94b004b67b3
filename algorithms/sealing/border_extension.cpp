// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/border_extension.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

Point3 plus(const Point3& a, const Point3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Point3 times(double f, const Point3& a) {
    return {f * a.x, f * a.y, f * a.z};
}

/// Scales a vector to length 1; zero if it has none.
Point3 unit(const Point3& a) {
    const double size = std::hypot(a.x, a.y, a.z);
    return size > 0 && std::isfinite(size) ? times(1 / size, a) : Point3{};
}

Axis axis_of(const Arrangement& a, InputTriangleId input_triangle) {
    const Triangle& c = a.state->corners[input_triangle];
    return projection_axis(a.state->points.input(c[0]), a.state->points.input(c[1]),
                           a.state->points.input(c[2]));
}

/// Key of an undirected edge of a surface.
using EdgeKey = std::array<std::uint32_t, 3>;

EdgeKey key_of(SurfaceId surface, std::uint32_t a, std::uint32_t b) {
    return {surface, std::min(a, b), std::max(a, b)};
}

/// Finds the border edges of some surfaces, from their distinct nondegenerate triangles.
std::map<EdgeKey, BorderEdge> borders_of(const Arrangement& a, const std::vector<bool>& is_asked,
                                         const std::vector<bool>& unusable) {
    const auto& inputs = a.inputs;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> number; // ascending, and so surface by surface
    std::vector<SurfaceId> surface_of;
    for (SurfaceId s; s < is_asked.size(); s = SurfaceId(s + 1))
        for (std::uint32_t t = inputs.first[s]; is_asked[s] && t < inputs.first[s + 1]; ++t) {
            if (unusable[t]) continue;
            triangles.push_back(a.state->corners[t]);
            number.push_back(t);
            surface_of.push_back(s);
        }
    std::map<EdgeKey, BorderEdge> borders;
    const auto add = [&](std::uint32_t low, std::uint32_t high, std::uint32_t t) {
        const bool along = runs_along(triangles[t], low, high);
        borders[key_of(surface_of[t], low, high)] = {surface_of[t],
                                                     InputTriangleId(number[t]),
                                                     along ? low : high,
                                                     along ? high : low,
                                                     {},
                                                     {}};
    };
    group_edges(triangles, a.state->points.input_count())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
                while (end < sides.size() &&
                       surface_of[sides[end].triangle] == surface_of[sides[k].triangle])
                    ++end;
                if (end - k == 1) add(low, high, sides[k].triangle);
            }
        });
    return borders;
}

/// A vertex of extended borders.
struct Vertex {
    std::vector<std::uint32_t> edges{}; ///< strip edges at it
    double reach = 0;
    Point3 beyond{}; ///< end of the strip
};

class Builder {
public:
    Builder(const Arrangement& a, std::span<const StripEdge> edges) : a_(a), edges_(edges) {}

    std::vector<ExtensionTriangle> operator()() {
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            for (const std::uint32_t v : {edges_[e].edge.from, edges_[e].edge.to}) {
                Vertex& vertex = vertices_[{edges_[e].edge.surface, v}];
                vertex.edges.push_back(e);
                vertex.reach = std::max(vertex.reach, edges_[e].reach);
            }
        for (auto& [key, vertex] : vertices_) place(key[1], vertex);
        for (const StripEdge& e : edges_) add_quad(e);
        std::uint32_t piece = 0;
        for (const StripEdge& e : edges_) piece = std::max(piece, e.piece + 1);
        for (const auto& [key, vertex] : vertices_)
            if (vertex.edges.size() == 1) add_fan(key[1], vertex, piece++);
        return std::move(strips_);
    }

private:
    [[nodiscard]] const Point3& at(std::uint32_t v) const { return a_.state->points.input(v); }

    [[nodiscard]] Point3 outward(const StripEdge& e) const { return outward_of(a_, e.edge); }

    void place(std::uint32_t v, Vertex& vertex) {
        Point3 sum{}, target_sum{};
        std::size_t targets = 0;
        for (const std::uint32_t e : vertex.edges) {
            sum = plus(sum, outward(edges_[e]));
            if (!edges_[e].targets) continue;
            target_sum = plus(target_sum, (*edges_[e].targets)[edges_[e].edge.from == v ? 0 : 1]);
            ++targets;
        }
        const Point3 mean = unit(sum);
        // Mitred: as far from each edge as the reach, but without spikes.
        const double cosine = dot(mean, outward(edges_[vertex.edges[0]]));
        vertex.beyond =
            plus(at(v),
                 times(vertex.reach / std::max(cosine, strip_constants.least_mitre_cosine), mean));
        if (targets == 0) return;
        const Point3 target = times(1 / static_cast<double>(targets), target_sum);
        const Point3 way = minus(target, at(v));
        if (way != Point3{})
            vertex.beyond = plus(target, times(strip_constants.beyond_targets, way));
    }

    void add(const StripEdge& e, std::uint32_t piece, bool is_fan,
             const std::array<Point3, 3>& corners, const std::array<bool, 3>& is_base,
             unsigned side) {
        if (collinear(corners[0], corners[1], corners[2])) return;
        strips_.push_back({e.edge.surface, piece, is_fan, corners, is_base, side, {}});
    }

    void add_quad(const StripEdge& e) {
        const Point3 &a = at(e.edge.from), &b = at(e.edge.to);
        const Point3 a1 = vertices_.at({e.edge.surface, e.edge.from}).beyond,
                     b1 = vertices_.at({e.edge.surface, e.edge.to}).beyond;
        add(e, e.piece, false, {b, a, a1}, {true, true, false}, 1);
        add(e, e.piece, false, {b, a1, b1}, {true, false, false}, 2);
    }

    /// Widens the end of a chain: sideways by as much as the strip reaches.
    void add_fan(std::uint32_t v, const Vertex& vertex, std::uint32_t piece) {
        const StripEdge& e = edges_[vertex.edges[0]];
        const bool starts = e.edge.from == v;
        const Point3 away = unit(minus(at(v), at(starts ? e.edge.to : e.edge.from)));
        const double reach =
            std::max(vertex.reach, std::hypot(vertex.beyond.x - at(v).x, vertex.beyond.y - at(v).y,
                                              vertex.beyond.z - at(v).z));
        const Point3 side = plus(vertex.beyond, times(reach, away));
        if (starts)
            add(e, piece, true, {at(v), side, vertex.beyond}, {true, false, false}, 2);
        else
            add(e, piece, true, {at(v), vertex.beyond, side}, {true, false, false}, 0);
    }

    const Arrangement& a_;
    std::span<const StripEdge> edges_;
    std::map<std::array<std::uint32_t, 2>, Vertex> vertices_; ///< by surface and vertex
    std::vector<ExtensionTriangle> strips_;
};

} // namespace

bool lies_on(UpwardWitness upward, const Arrangement& a, const Edge& edge,
             InputTriangleId input_triangle, std::uint32_t from, std::uint32_t to) {
    const Axis axis = axis_of(a, input_triangle);
    return std::all_of(edge.begin(), edge.end(), [&](std::uint32_t v) {
        return a.state->points.orient2d(upward, axis, from, to, a.vertices[v]) == Sign::Zero;
    });
}

std::vector<BorderEdge> open_border_edges(const Arrangement& a, std::vector<bool> unusable) {
    unusable.resize(a.state->corners.size(), false);
    for (const std::uint32_t t : a.degenerate) unusable[t] = true;
    for (const auto& [repeated, first] : a.inputs.duplicates)
        if (a.inputs.surface_of(InputTriangleId(repeated)) ==
            a.inputs.surface_of(InputTriangleId(first)))
            unusable[repeated] = true;
    std::vector<bool> has_open(a.surfaces.size(), false);
    std::vector<std::uint32_t> open; // edges of the adjacency
    for (std::uint32_t e = 0; e < a.state->adjacency.edges.size(); ++e) {
        const auto at = a.state->adjacency.triangles_at[e];
        if (at.size() != 1) continue;
        open.push_back(e);
        for (const std::uint32_t s : a.surfaces_of[at[0]]) has_open[s] = true;
    }
    auto borders = borders_of(a, has_open, unusable);
    const UpwardRounding guard;
    for (const std::uint32_t e : open)
        for (const std::uint32_t parent : a.parents_of[a.state->adjacency.triangles_at[e][0]]) {
            const InputTriangleId p(parent);
            const Triangle& c = a.state->corners[p];
            for (unsigned k = 0; k < 3; ++k) {
                const auto border =
                    borders.find(key_of(a.inputs.surface_of(p), c[k], c[(k + 1) % 3]));
                if (border == borders.end() || border->second.triangle != p ||
                    !lies_on(guard, a, a.state->adjacency.edges[e], p, c[k], c[(k + 1) % 3]))
                    continue;
                border->second.open.push_back(a.state->adjacency.edges[e]);
                const auto own = a.surfaces_of[a.state->adjacency.triangles_at[e][0]];
                border->second.own.insert(border->second.own.end(), own.begin(), own.end());
                sort_unique(border->second.own);
            }
        }
    std::vector<BorderEdge> found;
    for (auto& [key, border] : borders)
        if (!border.open.empty()) found.push_back(std::move(border));
    return found;
}

Point3 outward_of(const Arrangement& a, const BorderEdge& edge) {
    const auto at = [&](std::uint32_t v) { return a.state->points.input(v); };
    const Triangle& c = a.state->corners[edge.triangle];
    const Point3 n = unit(cross(minus(at(c[1]), at(c[0])), minus(at(c[2]), at(c[0]))));
    return unit(cross(unit(minus(at(edge.to), at(edge.from))), n));
}

std::vector<ExtensionTriangle> make_strips(const Arrangement& a, std::span<const StripEdge> edges) {
    return Builder(a, edges)();
}

void append_strips(std::vector<Surface>& surfaces, std::span<const ExtensionTriangle> strips) {
    for (const ExtensionTriangle& t : strips) {
        Surface& s = surfaces[t.surface];
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        s.vertices.insert(s.vertices.end(), t.corners.begin(), t.corners.end());
        s.triangles.push_back({first, first + 1, first + 2});
    }
}

} // namespace terrane
