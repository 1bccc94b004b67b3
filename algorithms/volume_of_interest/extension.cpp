// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volume_of_interest/known_extension.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>
#include <terrane/algorithms/sealing/extension_faces.hpp>
#include <terrane/algorithms/volume_of_interest/detail/constants.hpp>

namespace terrane {

using namespace volume_of_interest::detail;

namespace {

constexpr double past_targets = 1 + strip_constants.beyond_targets; ///< see StripEdge::targets

Point3 along(const Point3& from, double by, const Point3& way) {
    return {from.x + by * way.x, from.y + by * way.y, from.z + by * way.z};
}

/// Computes the directions of strips at the vertices of borders.
class Directions {
public:
    Directions(const Arrangement& a, std::span<const BorderEdge> edges, double limit) :
        a_(a), edges_(edges), limit_(limit) {
        DisjointSets sets(edges.size());
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            for (const std::uint32_t v : {edges[e].from, edges[e].to}) {
                auto& at = at_vertex_[{edges[e].surface, v}];
                if (!at.empty()) sets.join(at[0], e);
                at.push_back(e);
            }
            outward_.push_back(outward_of(edges[e]));
            lengths_.push_back(length(minus(at(edges[e].to), at(edges[e].from))));
        }
        std::vector<double> total(edges.size(), 0);
        for (std::uint32_t e = 0; e < edges.size(); ++e) total[sets.find(e)] += lengths_[e];
        for (std::uint32_t e = 0; e < edges.size(); ++e)
            windows_.push_back(std::min(extension_tuning.window * limit,
                                        extension_tuning.border_share * total[sets.find(e)]));
        for (unsigned i = 0; i < extension_tuning.most_doublings; ++i) widen_where_folded(sets);
    }
    /// Returns the point at which the strip aims from a vertex. The strip goes beyond it by half,
    /// to the limit.
    [[nodiscard]] Point3 target(SurfaceId surface, std::uint32_t vertex) const {
        const auto& edges = at_vertex_.at({surface, vertex});
        Point3 sum{};
        double weight = 0;
        for (const std::uint32_t e : edges) walk(surface, vertex, e, sum, weight);
        const double size = length(sum) / weight; // 1 along a straight border
        if (!(size > 0)) return along(at(vertex), limit_ / past_targets, outward_[edges[0]]);
        const double by =
            limit_ / past_targets / std::max(size, strip_constants.least_mitre_cosine);
        return along(at(vertex), by / (size * weight), sum);
    }

private:
    /// Doubles the averaging windows along borders whose strip runs backwards somewhere.
    void widen_where_folded(DisjointSets& borders) {
        std::vector<bool> folded(edges_.size(), false);
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            const BorderEdge& edge = edges_[e];
            const Point3 along_border = minus(at(edge.to), at(edge.from));
            const Point3 from = minus(target(edge.surface, edge.from), at(edge.from)),
                         to = minus(target(edge.surface, edge.to), at(edge.to));
            const Point3 outer = along(along_border, past_targets, minus(to, from));
            if (!(dot(outer, along_border) > 0)) folded[borders.find(e)] = true;
        }
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            if (folded[borders.find(e)]) windows_[e] *= 2;
    }

    [[nodiscard]] const Point3& at(std::uint32_t v) const { return a_.state->points.input(v); }
    /// Returns the unit vector in the plane of the edge's triangle, perpendicular to the edge and
    /// away from the triangle.
    [[nodiscard]] Point3 outward_of(const BorderEdge& e) const {
        const Triangle& c = a_.state->corners[e.triangle];
        const Point3 n = cross(minus(at(c[1]), at(c[0])), minus(at(c[2]), at(c[0]))),
                     way = cross(minus(at(e.to), at(e.from)), n);
        return along({}, 1 / length(way), way);
    }

    /// Adds the directions of the edges from a vertex on, weighted by their lengths within the
    /// window.
    void walk(SurfaceId surface, std::uint32_t vertex, std::uint32_t edge, Point3& sum,
              double& weight) const {
        double left = windows_[edge];
        while (true) {
            const double part = std::min(left, lengths_[edge]);
            sum = along(sum, part, outward_[edge]);
            weight += part;
            left -= part;
            if (!(left > 0)) return;
            vertex = edges_[edge].from == vertex ? edges_[edge].to : edges_[edge].from;
            const auto& next = at_vertex_.at({surface, vertex});
            if (next.size() != 2) return; // the border ends or branches
            edge = next[next[0] == edge ? 1 : 0];
        }
    }

    const Arrangement& a_;
    std::span<const BorderEdge> edges_;
    const double limit_;
    std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> at_vertex_; ///< edges
    std::vector<Point3> outward_;                                                  ///< per edge
    std::vector<double> lengths_, windows_;                                        ///< per edge
};

/// Finds the free borders inside the volume of surfaces that are to be extended.
std::vector<BorderEdge> borders_inside(const Arrangement& inside) {
    auto edges = open_border_edges(inside);
    std::erase_if(edges, [&](const BorderEdge& e) {
        const Role role = inside.surfaces[e.surface].role;
        return role == Role::fault || role == Role::boundary;
    });
    return edges;
}

std::vector<ExtensionTriangle> strips_beyond(const Arrangement& a,
                                             std::span<const BorderEdge> edges, double limit) {
    const Directions directions(a, edges, limit);
    std::vector<StripEdge> wanted;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const BorderEdge& edge = edges[e];
        wanted.push_back({edge, limit,
                          std::array{directions.target(edge.surface, edge.from),
                                     directions.target(edge.surface, edge.to)},
                          e});
    }
    return make_strips(a, wanted);
}

/// Tells exactly whether a part of a strip inside the volume contains the outer edge of the strip
/// or an outer corner, which means that the strip ends inside.
bool ends_here(UpwardWitness upward, const Arrangement& a, TriangleId t, InputTriangleId parent,
               const ExtensionTriangle& strip) {
    const Triangle &corners = a.state->corners[parent], &part = a.triangles[t];
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned next = (k + 1) % 3;
        const bool is_outer =
            strip.is_fan ? k != strip.side : !strip.is_base[k] && !strip.is_base[next];
        for (unsigned i = 0; i < 3; ++i) {
            if (!strip.is_base[k] && a.vertices[part[i]] == corners[k]) return true;
            const Edge edge{part[i], part[(i + 1) % 3]};
            if (is_outer && lies_on(upward, a, edge, parent, corners[k], corners[next]))
                return true;
        }
    }
    return false;
}

/// Decides for each piece (border edges, then fans) whether it leaves the volume along its whole
/// length.
Result<std::vector<bool>> find_reached(std::vector<Surface> surfaces,
                                       std::span<const ExtensionTriangle> strips,
                                       std::size_t pieces, std::span<const std::uint32_t> boundary,
                                       const ExtendOptions& options, KnownTriangles& known,
                                       const Run& run) {
    append_strips(surfaces, strips);
    const auto a = arrange(surfaces, options.arrange, known, run);
    if (!a) return a.error();
    const auto where = locate(a.value(), boundary, run);
    if (!where) return where.error();
    const auto by_input = strips_by_input(a.value(), strips);
    for (const ExtensionTriangle& t : strips) pieces = std::max(pieces, t.piece + std::size_t{1});
    std::vector<bool> reached(pieces, false);
    for (const ExtensionTriangle& t : strips)
        reached[t.piece] = true; // includes pieces of
                                 // degenerate triangles
    const UpwardRounding guard;
    for (std::uint32_t t = 0; t < a.value().triangles.size(); ++t) {
        if (where.value()[t] != Where::inside) continue;
        for (const std::uint32_t p : a.value().parents_of[t])
            if (by_input[p] != no_index &&
                ends_here(guard, a.value(), TriangleId(t), InputTriangleId(p), strips[by_input[p]]))
                reached[strips[by_input[p]].piece] = false;
    }
    return reached;
}

/// Removes fans next to removed pieces.
void drop_lone_fans(std::vector<ExtensionTriangle>& strips) {
    std::set<std::pair<Point3, Point3>> sides;
    const auto side_of = [](const ExtensionTriangle& t) {
        return std::minmax({t.corners[t.side], t.corners[(t.side + 1) % 3]});
    };
    for (const ExtensionTriangle& t : strips)
        if (!t.is_fan) sides.insert(side_of(t));
    std::erase_if(strips, [&](const ExtensionTriangle& t) {
        return t.is_fan && !sides.contains(side_of(t));
    });
}

/// Lists connected edges with the same result as one entry.
std::vector<ExtendedBorder> list(const Arrangement& inside, std::span<const BorderEdge> edges,
                                 const std::vector<bool>& reached) {
    DisjointSets sets(edges.size());
    std::map<std::tuple<std::uint32_t, bool, std::uint32_t>, std::uint32_t> first;
    for (std::uint32_t e = 0; e < edges.size(); ++e)
        for (const std::uint32_t v : {edges[e].from, edges[e].to})
            if (const auto [it, is_new] = first.try_emplace({edges[e].surface, reached[e], v}, e);
                !is_new)
                sets.join(it->second, e);
    std::map<std::uint32_t, ExtendedBorder> borders;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        ExtendedBorder& border = borders[sets.find(e)];
        for (const Edge& part : edges[e].open) {
            const Point3 p = inside.state->points.nearest(inside.vertices[part[0]]),
                         q = inside.state->points.nearest(inside.vertices[part[1]]);
            const bool is_first = border.length == 0;
            border.place = is_first ? std::min(p, q) : std::min({border.place, p, q});
            border.length += length(minus(q, p));
        }
        border.surface = edges[e].surface;
        border.reached = reached[e];
        ++border.edges;
    }
    std::vector<ExtendedBorder> all;
    for (const auto& [set, border] : borders) all.push_back(border);
    std::sort(all.begin(), all.end(), [](const ExtendedBorder& b, const ExtendedBorder& c) {
        return std::tie(b.surface, b.place, b.length) < std::tie(c.surface, c.place, c.length);
    });
    return all;
}

Result<Extended> extend(std::vector<Surface> surfaces, std::span<const std::uint32_t> boundary,
                        const ExtendOptions& options, KnownTriangles& known, const Run& run) {
    auto a = arrange(surfaces, options.arrange, known, run);
    if (!a) return a.error();
    const auto cut = cut_to_volume(std::move(a).value(), boundary, run);
    if (!cut) return cut.error();
    const Arrangement& inside = cut.value().arrangement;
    const auto edges = borders_inside(inside);
    if (edges.empty()) return Extended{std::move(surfaces), {}};
    auto strips = strips_beyond(inside, edges, options.limit);
    const auto reached =
        find_reached(surfaces, strips, edges.size(), boundary, options, known, run);
    if (!reached) return reached.error();
    std::erase_if(strips, [&](const ExtensionTriangle& t) { return !reached.value()[t.piece]; });
    drop_lone_fans(strips);
    append_strips(surfaces, strips);
    return Extended{std::move(surfaces), list(inside, edges, reached.value())};
}

} // namespace

Result<Extended> extend_to_boundary(std::vector<Surface> surfaces,
                                    std::span<const std::uint32_t> boundary,
                                    const ExtendOptions& options, const Run& run) {
    KnownTriangles known;
    return extend_to_boundary(std::move(surfaces), boundary, options, known, run);
}

Result<Extended> extend_to_boundary(std::vector<Surface> surfaces,
                                    std::span<const std::uint32_t> boundary,
                                    const ExtendOptions& options, KnownTriangles& known,
                                    const Run& run) {
    return guarded("to extend surfaces", "extend", [&]() -> Result<Extended> {
        if (!(options.limit > 0) || !std::isfinite(options.limit))
            return Error{ErrorCode::bad_option, "the limit must be positive", "extend"};
        const StageTimer timer(run, "extend");
        return extend(std::move(surfaces), boundary, options, known, timer.inside());
    });
}

std::vector<NamedConstant> extension_constants() {
    return {{"window", extension_tuning.window},
            {"border_share", extension_tuning.border_share},
            {"most_doublings", static_cast<double>(extension_tuning.most_doublings)},
            {"least_mitre_cosine", strip_constants.least_mitre_cosine},
            {"beyond_targets", strip_constants.beyond_targets}};
}

} // namespace terrane
