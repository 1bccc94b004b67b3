// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/detail/bridges.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sealing/detail/constants.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::sealing::detail {
namespace {

/// Returns the part of a vector that is perpendicular to another one.
Point3 across(const Point3& v, const Point3& along) {
    const double square = dot(along, along);
    const double f = square > 0 ? dot(v, along) / square : 0;
    return {v.x - f * along.x, v.y - f * along.y, v.z - f * along.z};
}

/// The ends of a way from one border to another, or to another part of it.
struct Way {
    std::array<std::uint32_t, 2> at{};      ///< vertices
    std::array<std::uint32_t, 2> surface{}; ///< whose border the vertex is on
};

/// A triangle of a bridge: a border edge and a vertex of the other border.
struct Link {
    std::uint32_t edge = 0;        ///< the border edge
    std::uint32_t apex = 0;        ///< the vertex on the other border
    std::uint32_t last = no_index; ///< another border edge that it lies on, too: there the gap ends
    double length = 0;             ///< of the new way; 0 where the gap ends
    Way next{};                    ///< the new way
    std::uint32_t ahead = 0;       ///< the vertex that the step led to
    Point3 heading{};              ///< of the step, along the border
};

class Builder {
public:
    Builder(const Arrangement& a, const FacingBorders& borders, std::uint32_t first_piece) :
        a_(a), borders_(borders), edges_(borders.edges()), first_piece_(first_piece) {
        bridges_.is_bridged.assign(edges_.size(), false);
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            facing_.push_back(borders.facing(e));
            by_ends_[{edges_[e].surface, ends_of(e)}] = e;
            if (!facing_[e]) continue;
            at_[{edges_[e].surface, edges_[e].from}].push_back(e);
            at_[{edges_[e].surface, edges_[e].to}].push_back(e);
        }
    }

    Bridges operator()() {
        for (std::uint32_t e = 0; e < edges_.size(); ++e) fill_triangle(e);
        for (const Seed& seed : seeds())
            if (!bridges_.is_bridged[seed.edges[0]] && !bridges_.is_bridged[seed.edges[1]])
                build(seed.way);
        return std::move(bridges_);
    }

private:
    struct Seed {
        double length = 0;
        std::array<Point3, 2> ends{}; ///< ascending
        std::array<std::uint32_t, 2> edges{};
        Way way{};
    };

    [[nodiscard]] const Point3& place(std::uint32_t v) const { return a_.state->points.input(v); }
    [[nodiscard]] std::array<std::uint32_t, 2> ends_of(std::uint32_t e) const {
        return {std::min(edges_[e].from, edges_[e].to), std::max(edges_[e].from, edges_[e].to)};
    }
    [[nodiscard]] std::uint32_t other_end(std::uint32_t e, std::uint32_t v) const {
        return edges_[e].from == v ? edges_[e].to : edges_[e].from;
    }
    /// Tells whether a way can be a side of a bridge: it is no border edge, and lies in the gap.
    [[nodiscard]] bool is_possible(const Way& way) const {
        const auto& [v, w] = way.at;
        if (v == w) return false;
        if (edge_between(way) != no_index) return false;
        return borders_.is_in_gap(place(v), place(w), way.surface[0], way.surface[1]);
    }

    /// Returns the border edge that a way lies on; none: no_index.
    [[nodiscard]] std::uint32_t edge_between(const Way& way) const {
        const auto [low, high] = std::minmax(way.at[0], way.at[1]);
        for (const std::uint32_t s : way.surface)
            if (const auto it = by_ends_.find({s, {low, high}}); it != by_ends_.end())
                return it->second;
        return no_index;
    }

    /// Fills a gap that has three border edges of one surface: at a vertex near another edge, for
    /// instance, there is no way from one to another that is not one of them.
    void fill_triangle(std::uint32_t e) {
        if (!facing_[e] || bridges_.is_bridged[e]) return;
        const std::uint32_t f = facing_[e]->edge, surface = surface_of(e);
        if (bridges_.is_bridged[f] || surface_of(f) != surface) return;
        for (const std::uint32_t v : ends_of(e)) {
            if (edges_[f].from != v && edges_[f].to != v) continue;
            const Way way{{other_end(e, v), other_end(f, v)}, {surface, surface}};
            const std::uint32_t third = edge_between(way);
            if (third == no_index || bridges_.is_bridged[third] ||
                collinear(place(v), place(way.at[0]), place(way.at[1])))
                continue;
            for (const std::uint32_t side : {e, f, third}) bridges_.is_bridged[side] = true;
            return add({{e, way.at[1], f, 0, way, way.at[1], {}}}, surface);
        }
    }

    /// Lists the ways between the ends of edges that face each other, the shortest first.
    [[nodiscard]] std::vector<Seed> seeds() const {
        std::vector<Seed> all;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (!facing_[e] || !facing_[facing_[e]->edge]) continue;
            const std::uint32_t f = facing_[e]->edge;
            for (const std::uint32_t v : ends_of(e))
                for (const std::uint32_t w : ends_of(f)) {
                    const Way way{{v, w}, {edges_[e].surface, edges_[f].surface}};
                    if (!is_possible(way)) continue;
                    const auto [low, high] = std::minmax(place(v), place(w));
                    all.push_back({length(minus(high, low)), {low, high}, {e, f}, way});
                }
        }
        std::ranges::sort(all, {}, [&](const Seed& s) {
            return std::tuple(s.length, s.ends, key_of(s.edges[0]), key_of(s.edges[1]));
        });
        return all;
    }
    /// Returns the ends of an edge in a form that does not depend on numbers.
    [[nodiscard]] std::array<Point3, 2> key_of(std::uint32_t e) const {
        const auto [low, high] = std::minmax(place(edges_[e].from), place(edges_[e].to));
        return {low, high};
    }

    /// Finds the step over one of the edges at a way's end that leads to the shortest new way.
    /// `heading`: the direction in which the bridge goes, if it has one.
    [[nodiscard]] std::optional<Link> step(const Way& way,
                                           const std::optional<Point3>& heading) const {
        std::optional<Link> best;
        for (unsigned i = 0; i < 2; ++i) {
            const auto it = at_.find({way.surface[i], way.at[i]});
            if (it == at_.end()) continue;
            for (const std::uint32_t e : it->second) {
                const auto link = link_over(way, i, e, heading);
                if (!link) continue;
                if (!best || std::tuple(link->length, place(link->ahead)) <
                                 std::tuple(best->length, place(best->ahead)))
                    best = link;
            }
        }
        return best;
    }

    [[nodiscard]] std::optional<Link> link_over(const Way& way, unsigned i, std::uint32_t e,
                                                const std::optional<Point3>& heading) const {
        const std::uint32_t from = way.at[i], apex = way.at[1 - i], ahead = other_end(e, from);
        if (bridges_.is_bridged[e] || edges_[facing_[e]->edge].surface != way.surface[1 - i] ||
            ahead == apex || collinear(place(from), place(ahead), place(apex)))
            return std::nullopt;
        const Point3 out =
            across(minus(place(apex), place(from)), minus(place(ahead), place(from)));
        if (dot(borders_.outward(e), out) < constants.least_beside * length(out))
            return std::nullopt;
        const Point3 along = minus(place(ahead), place(from));
        if (heading &&
            dot(along, *heading) < constants.least_turn * length(along) * length(*heading))
            return std::nullopt; // the bridge would turn back
        Link link{e, apex, no_index, 0, way, ahead, along};
        link.next.at[i] = ahead;
        link.last = edge_between(link.next);
        if (link.last != no_index)
            return bridges_.is_bridged[link.last] ? std::nullopt : std::optional(link);
        if (!is_possible(link.next)) return std::nullopt;
        link.length = length(minus(place(ahead), place(apex)));
        return link;
    }

    /// Goes on from a way until there is no step; marks the edges.
    std::vector<Link> go(Way way, std::optional<Point3> heading) {
        std::vector<Link> links;
        while (const auto link = step(way, heading)) {
            bridges_.is_bridged[link->edge] = true;
            links.push_back(*link);
            if (link->last != no_index) {
                bridges_.is_bridged[link->last] = true;
                break;
            }
            heading = link->heading;
            way = link->next;
        }
        return links;
    }

    void build(const Way& first) {
        auto links = go(first, std::nullopt);
        if (links.empty()) return;
        const Point3& heading = links.front().heading;
        const auto back = go(first, Point3{-heading.x, -heading.y, -heading.z});
        std::ranges::reverse(links);
        links.insert(links.end(), back.begin(), back.end());
        std::array<bool, 2> joined{};
        for (const Link& link : links)
            for (unsigned i = 0; i < 2; ++i)
                joined[i] = joined[i] || surface_of(link.edge) == first.surface[i] ||
                            (link.last != no_index && surface_of(link.last) == first.surface[i]);
        if (!joined[0] || !joined[1] || (links.size() == 1 && links[0].last == no_index)) {
            for (const Link& link : links) bridges_.is_bridged[link.edge] = false;
            return;
        }
        const bool is_first = place(first.at[0]) < place(first.at[1]);
        const auto has = [&](std::uint32_t s) {
            return std::ranges::any_of(links,
                                       [&](const Link& l) { return surface_of(l.edge) == s; });
        };
        std::uint32_t owner = first.surface[is_first ? 0 : 1];
        if (!has(owner)) owner = first.surface[is_first ? 1 : 0];
        add(links, owner);
    }

    [[nodiscard]] std::uint32_t surface_of(std::uint32_t e) const { return edges_[e].surface; }

    /// Adds the triangles of a bridge: pieces are the edges of the owner; what lies on other edges
    /// belongs to the piece before, or to the first one.
    void add(const std::vector<Link>& links, std::uint32_t owner) {
        auto piece = static_cast<std::uint32_t>(first_piece_ + bridges_.gaps.size());
        bool is_any = false;
        // The side that the last triangle of the owner faces, or that the first one will face.
        Point3 side = normal_of(*std::ranges::find_if(
            links, [&](const Link& l) { return surface_of(l.edge) == owner; }));
        for (const Link& link : links) {
            const bool is_own = surface_of(link.edge) == owner;
            if (is_own) {
                if (is_any) ++piece;
                is_any = true;
                side = normal_of(link);
                bridges_.gaps.push_back(gap_of(link));
            }
            add(link, piece, owner, is_own || dot(side, normal_of(link)) >= 0);
        }
    }

    [[nodiscard]] Point3 normal_of(const Link& link) const {
        const BorderEdge& e = edges_[link.edge];
        return cross(minus(place(e.from), place(e.to)), minus(place(link.apex), place(e.to)));
    }

    [[nodiscard]] Gap gap_of(const Link& link) const {
        Gap gap{edges_[link.edge], 0, -1, {}, 0};
        for (const std::uint32_t e : {link.edge, link.last}) {
            if (e == no_index || surface_of(e) != surface_of(link.edge)) continue;
            gap.length += borders_.length_of(e);
            if (!facing_[e] || facing_[e]->distance <= gap.largest) continue;
            gap.largest = facing_[e]->distance;
            gap.place = facing_[e]->place;
            gap.to = edges_[facing_[e]->edge].surface;
        }
        return gap;
    }

    void add(const Link& link, std::uint32_t piece, std::uint32_t owner, bool as_edge) {
        const BorderEdge& e = edges_[link.edge];
        const std::uint32_t first = as_edge ? e.to : e.from, second = as_edge ? e.from : e.to;
        ExtensionTriangle t;
        t.surface = SurfaceId(owner);
        t.piece = piece;
        t.corners = {place(first), place(second), place(link.apex)};
        t.is_base = {true, true, true};
        const std::array corners{first, second, link.apex};
        for (std::size_t k = 0; k < 3; ++k)
            t.joins[k] =
                edge_between({{corners[k], corners[(k + 1) % 3]}, link.next.surface}) != no_index;
        bridges_.triangles.push_back(t);
    }

    const Arrangement& a_;
    const FacingBorders& borders_;
    const std::span<const BorderEdge> edges_;
    const std::uint32_t first_piece_;
    std::vector<std::optional<FacingBorders::Facing>> facing_; ///< per edge
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>
        at_; ///< edges that face others, by surface and vertex
    std::map<std::pair<std::uint32_t, std::array<std::uint32_t, 2>>, std::uint32_t>
        by_ends_; ///< all edges, by surface and ends
    Bridges bridges_;
};

} // namespace

Bridges make_bridges(const Arrangement& arrangement, const FacingBorders& borders,
                     std::uint32_t first_piece) {
    return Builder(arrangement, borders, first_piece)();
}

} // namespace terrane::sealing::detail
