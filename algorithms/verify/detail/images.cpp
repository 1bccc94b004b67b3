// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_images of rounded_parts.hpp.
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

namespace {

/// How a set of vertices, edges and triangles is connected.
struct Shape {
    std::size_t pieces = 0;
    std::int64_t holes = 0; ///< number of pieces less the Euler characteristic
    bool closed = false;    ///< triangles are left when those at free edges are taken away
};

/// Vertices, edges and triangles that input triangles have in common.
struct Common {
    Numbers vertices;
    std::vector<Edge> edges;
    Numbers triangles;
};

/// Sorts pairs {input triangle, value} and lists the values, each once.
template <class T>
IndexLists<T> lists_of(std::vector<std::pair<std::uint32_t, T>> pairs, std::size_t inputs) {
    make_set(pairs);
    Numbers keys;
    for (const auto& [key, value] : pairs) keys.push_back(key);
    return lists_by_key<T>(inputs, keys, [&](std::size_t i) { return pairs[i].second; });
}

/// The image of each input triangle in a mesh: the triangles that name it, with their edges and
/// vertices.
class Images {
public:
    Images(const Parts& parts, IndexLists<std::uint32_t> children) :
        triangles_(parts.triangles), children_(std::move(children)) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;
        std::vector<std::pair<std::uint32_t, Edge>> edges;
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (const HalfEdge& side : sides_of(triangles_[t])) {
                for (const std::uint32_t parent : parts.parents_of[t]) {
                    vertices.emplace_back(parent, side.apex);
                    edges.emplace_back(parent, side.edge);
                }
            }
        vertices_ = lists_of(std::move(vertices), children_.size());
        edges_ = lists_of(std::move(edges), children_.size());
    }

    [[nodiscard]] Common common(const Numbers& inputs) const {
        return {shared(vertices_, inputs), shared(edges_, inputs), shared(children_, inputs)};
    }
    [[nodiscard]] bool meet(const Numbers& inputs) const {
        return !shared(vertices_, inputs).empty();
    }
    /// Returns the most triangles of the images of input triangles at an edge along which all of
    /// these meet; 0 if they do not.
    [[nodiscard]] std::size_t most_along_an_edge(const Numbers& inputs) const {
        const auto common = shared(edges_, inputs);
        if (common.empty()) return 0;
        const auto uses = uses_of(inputs);
        std::size_t most = 0;
        for (const Edge& edge : common) most = std::max(most, uses.at(edge));
        return most;
    }

    /// Returns the edges of which one triangle belongs to the images of input triangles.
    [[nodiscard]] std::vector<Edge> border(const Numbers& inputs) const {
        std::vector<Edge> once;
        for (const auto& [edge, count] : uses_of(inputs))
            if (count == 1) once.push_back(edge);
        return once;
    }

    [[nodiscard]] Shape shape(const Common& of) const {
        JoinedSets sets(of.vertices.size());
        const auto place = [&](std::uint32_t v) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(of.vertices, v) -
                                              of.vertices.begin());
        };
        for (const auto& [a, b] : of.edges) sets.join(place(a), place(b));
        Shape result;
        for (std::uint32_t v = 0; v < of.vertices.size(); ++v)
            if (sets.find(v) == v) ++result.pieces;
        result.holes = static_cast<std::int64_t>(result.pieces + of.edges.size()) -
                       static_cast<std::int64_t>(of.vertices.size() + of.triangles.size());
        result.closed = is_closed(of.triangles);
        return result;
    }

private:
    /// Returns how many triangles of the images of input triangles are at each edge.
    [[nodiscard]] std::map<Edge, std::size_t> uses_of(const Numbers& inputs) const {
        Numbers triangles;
        for (const std::uint32_t input : inputs)
            triangles.insert(triangles.end(), children_[input].begin(), children_[input].end());
        make_set(triangles);
        std::map<Edge, std::size_t> uses;
        for (const std::uint32_t t : triangles)
            for (const HalfEdge& side : sides_of(triangles_[t])) ++uses[side.edge];
        return uses;
    }

    /// Returns the values that are in the lists of all inputs. Cost: of the shortest list.
    template <class T>
    static std::vector<T> shared(const IndexLists<T>& lists, const Numbers& inputs) {
        const auto shortest =
            std::ranges::min(inputs, {}, [&](std::uint32_t input) { return lists[input].size(); });
        std::vector<T> result;
        for (const T& value : lists[shortest])
            if (std::ranges::all_of(inputs, [&](std::uint32_t input) {
                    return std::ranges::binary_search(lists[input], value);
                }))
                result.push_back(value);
        return result;
    }

    /// Tells whether triangles are left when those with a free edge are taken away one by one.
    [[nodiscard]] bool is_closed(const Numbers& which) const {
        std::map<Edge, Numbers> at;
        for (const std::uint32_t t : which)
            for (const HalfEdge& side : sides_of(triangles_[t])) at[side.edge].push_back(t);
        std::vector<Edge> open;
        for (const auto& [edge, triangles] : at)
            if (triangles.size() == 1) open.push_back(edge);
        std::size_t left = which.size();
        while (!open.empty()) {
            const Numbers free = at[open.back()];
            open.pop_back();
            if (free.empty()) continue;
            --left;
            for (const HalfEdge& side : sides_of(triangles_[free[0]])) {
                std::erase(at[side.edge], free[0]);
                if (at[side.edge].size() == 1) open.push_back(side.edge);
            }
        }
        return left != 0;
    }

    std::span<const Triangle> triangles_;
    IndexLists<std::uint32_t> children_;
    IndexLists<std::uint32_t> vertices_;
    IndexLists<Edge> edges_;
};

/// Sets of input triangles that meet in vertices, and along edges. What has vanished is left out.
struct Meetings {
    std::set<Numbers> in_vertices;
    std::map<Numbers, std::size_t> along_edges; ///< with the most triangles at such an edge

    Meetings(const Parts& parts, const Numbers& vanished) {
        std::map<std::uint32_t, Numbers> at;
        std::map<Edge, std::pair<Numbers, std::size_t>> along;
        for (std::size_t t = 0; t < parts.triangles.size(); ++t)
            for (const HalfEdge& side : sides_of(parts.triangles[t])) {
                auto& [inputs, count] = along[side.edge];
                ++count;
                for (Numbers* all : {&at[side.apex], &inputs})
                    all->insert(all->end(), parts.parents_of[t].begin(), parts.parents_of[t].end());
            }
        const auto names_some = [&](Numbers& all) {
            make_set(all);
            std::erase_if(all, [&](auto p) { return std::ranges::binary_search(vanished, p); });
            return !all.empty();
        };
        for (auto& [v, all] : at)
            if (names_some(all)) in_vertices.insert(std::move(all));
        for (auto& [edge, value] : along)
            if (names_some(value.first)) {
                std::size_t& most = along_edges[std::move(value.first)];
                most = std::max(most, value.second);
            }
    }
};

class ImageChecks {
public:
    ImageChecks(const RoundedParts& parts, const Numbers& thinned, Violations& found) :
        parts_(parts), thinned_(thinned), found_(found),
        exact_({parts.exact.triangles, parts.exact.parents_of}, parts.exact_children),
        doubles_({parts.rounded.triangles, parts.rounded.parents_of}, parts.children) {}

    Differences operator()() {
        for (std::uint32_t t = 0; t < parts_.inputs.triangles.size(); ++t)
            if (!parts_.children[t].empty() && !parts_.exact_children[t].empty()) {
                check({t});
                if (is_slit({t})) ++slit_;
            }
        for (const Edge& pair : neighbours()) {
            if (doubles_.meet({pair[0], pair[1]})) {
                const auto side = common_side(pair);
                if (side.size() < 2) continue;
                check({pair[0], pair[1]});
                if (side.size() == 2 && ends_early(pair, side) && is_slit({pair[0], pair[1]}))
                    ++slit_;
            } else if (!is_thinned({pair[0], pair[1]}) && !do_surfaces_meet(pair) &&
                       is_crossing(pair)) {
                report({pair[0], pair[1]}, "meet no more, nor do their surfaces");
            }
        }
        return differences();
    }

private:
    void report(const Numbers& inputs, const std::string& what) {
        found_.push_back(
            {Rule::R37_images, inputs,
             (inputs.size() == 1 ? "the parts of input triangle " + text(inputs[0])
                                 : "input triangles " + text(Edge{inputs[0], inputs[1]})) +
                 " " + what});
    }

    /// Tells whether a part of one of these has vanished, or one is not wider than the deviation.
    [[nodiscard]] bool is_thinned(const Numbers& inputs) const {
        return std::ranges::any_of(inputs, [&](std::uint32_t input) {
            return std::ranges::binary_search(thinned_, input) ||
                   within(squared_height(parts_.input_corners(input)), parts_.deviation);
        });
    }

    /// Compares what one input triangle is, or what two of them have in common.
    void check(const Numbers& inputs) {
        const Shape before = exact_.shape(exact_.common(inputs));
        const Shape after = doubles_.shape(doubles_.common(inputs));
        const std::string common = inputs.size() == 1 ? "" : "have in common what ";
        if (after.closed)
            report(inputs, common + "enclose a space");
        else if (!is_thinned(inputs) && after.pieces > before.pieces)
            report(inputs, common + (common.empty() ? "are" : "is") + " torn");
        else if (!is_thinned(inputs) && after.holes > before.holes)
            report(inputs, common + (common.empty() ? "have" : "has") + " a hole");
    }

    /// Tells whether the images of input triangles together have a border far from the sides that one of these has. A slit
    /// that begins at a side is no hole.
    [[nodiscard]] bool is_slit(const Numbers& inputs) const {
        if (is_thinned(inputs)) return false;
        using Side = std::array<Vector4, 2>;
        std::map<Side, int> sides;
        for (const std::uint32_t input : inputs) {
            if (!parts_.is_cut.empty() && parts_.is_cut[input]) return false;
            const auto corners = parts_.input_corners(input);
            for (std::size_t i = 0; i < 3; ++i) {
                Side side{*corners[i], *corners[(i + 1) % 3]};
                std::ranges::sort(side);
                ++sides[std::move(side)];
            }
        }
        const auto is_far = [&](std::uint32_t v) {
            return std::ranges::none_of(sides, [&](const auto& side) {
                const auto& [start, end] = side.first;
                return side.second == 1 &&
                       within_of_segment(parts_.points[v], start, end, parts_.deviation);
            });
        };
        return std::ranges::any_of(doubles_.border(inputs), [&](const Edge& edge) {
            return is_far(edge[0]) || is_far(edge[1]);
        });
    }

    /// Tells whether the surfaces of two input triangles have a vertex of the doubles in common.
    [[nodiscard]] bool do_surfaces_meet(const Edge& pair) {
        if (vertices_of_surface_.empty())
            for (std::uint32_t t = 0; t < parts_.rounded.triangles.size(); ++t)
                for (const std::uint32_t parent : parts_.rounded.parents_of[t])
                    vertices_of_surface_[parts_.inputs.surface_of[parent]].insert(
                        parts_.rounded.triangles[t].begin(), parts_.rounded.triangles[t].end());
        const auto& ours = vertices_of_surface_[parts_.inputs.surface_of[pair[0]]];
        const auto& theirs = vertices_of_surface_[parts_.inputs.surface_of[pair[1]]];
        return std::ranges::any_of(ours, [&](std::uint32_t v) { return theirs.contains(v); });
    }

    /// Returns the corners that two input triangles have in common.
    [[nodiscard]] std::vector<const Vector4*> common_side(const Edge& pair) const {
        const auto ours = parts_.input_corners(pair[0]), theirs = parts_.input_corners(pair[1]);
        std::vector<const Vector4*> common;
        std::ranges::copy_if(ours, std::back_inserter(common), [&](const Vector4* corner) {
            return std::ranges::any_of(theirs,
                                       [&](const Vector4* other) { return *corner == *other; });
        });
        return common;
    }

    /// Tells whether what two images have in common ends before an end of the common side.
    [[nodiscard]] bool ends_early(const Edge& pair, const std::vector<const Vector4*>& side) const {
        const Numbers vertices = doubles_.common({pair[0], pair[1]}).vertices;
        return std::ranges::any_of(side, [&](const Vector4* end) {
            return std::ranges::none_of(vertices, [&](std::uint32_t v) {
                return within(parts_.points[v], *end, parts_.deviation);
            });
        });
    }

    /// Returns pairs of input triangles that link all those at each exact edge.
    [[nodiscard]] std::vector<Edge> neighbours() const {
        const auto& triangles = parts_.exact.triangles;
        std::vector<std::pair<Edge, std::uint32_t>> at;
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (const std::uint32_t parent : parts_.exact.parents_of[t])
                if (!parts_.children[parent].empty())
                    for (const HalfEdge& side : sides_of(triangles[t]))
                        at.emplace_back(side.edge, parent);
        std::sort(at.begin(), at.end());
        std::vector<Edge> pairs;
        for (std::size_t i = 1; i < at.size(); ++i)
            if (at[i - 1].first == at[i].first && at[i - 1].second != at[i].second)
                pairs.push_back({at[i - 1].second, at[i].second});
        make_set(pairs);
        return pairs;
    }

    /// Tells whether two input triangles have more than the deviation in common, and neither is
    /// nearly in the plane of the other: then rounding cannot part them.
    [[nodiscard]] bool is_crossing(const Edge& pair) const {
        std::vector<Vector4> points;
        for (const std::uint32_t v : exact_.common({pair[0], pair[1]}).vertices)
            points.push_back(construct(parts_.exact.vertices[v], parts_.input_points).value());
        return std::ranges::any_of(points,
                                   [&](const Vector4& p) {
                                       return !within(squared_distance(p, points[0]),
                                                      parts_.deviation);
                                   }) &&
               !is_flat(pair[0], pair[1]) && !is_flat(pair[1], pair[0]);
    }

    /// Tells whether all corners of one triangle are as near to the plane of another as is accepted.
    [[nodiscard]] bool is_flat(std::uint32_t one, std::uint32_t other) const {
        const auto corners = parts_.input_corners(other);
        const Vector3 normal = normal_of(corners);
        return std::ranges::all_of(parts_.input_corners(one), [&](const Vector4* corner) {
            const mpz_class height = dot(normal, difference(*corner, *corners[0]));
            return within(Squared{height * height, dot(normal, normal)}, parts_.accepted);
        });
    }

    /// Counts the meetings of a mesh that the images in the other one do not have.
    static std::size_t missing(const Meetings& of, const Meetings& in, const Images& images) {
        std::size_t count = 0;
        for (const Numbers& inputs : of.in_vertices)
            if (!in.in_vertices.contains(inputs) && !images.meet(inputs)) ++count;
        for (const auto& [inputs, triangles] : of.along_edges)
            if (!in.along_edges.contains(inputs) && images.most_along_an_edge(inputs) == 0) ++count;
        return count;
    }

    /// Counts the sets of input triangles that meet along an edge of more than two triangles, and
    /// of more than in the exact part.
    [[nodiscard]] std::size_t crowded(const Meetings& before, const Meetings& after) const {
        return static_cast<std::size_t>(
            std::ranges::count_if(after.along_edges, [&](const auto& meeting) {
                const auto& [inputs, triangles] = meeting;
                const auto same = before.along_edges.find(inputs);
                if (triangles <= 2 ||
                    (same != before.along_edges.end() && triangles <= same->second))
                    return false;
                const std::size_t most = exact_.most_along_an_edge(inputs);
                return most > 0 && triangles > most;
            }));
    }

    [[nodiscard]] Differences differences() const {
        const Numbers& vanished = parts_.rounded.vanished;
        const Meetings before({parts_.exact.triangles, parts_.exact.parents_of}, vanished);
        const Meetings after({parts_.rounded.triangles, parts_.rounded.parents_of}, vanished);
        return {missing(before, after, doubles_) + slit_,
                missing(after, before, exact_) + crowded(before, after)};
    }

    const RoundedParts& parts_;
    const Numbers& thinned_;
    Violations& found_;
    Images exact_, doubles_;
    std::size_t slit_ =
        0; ///< number of input triangles, and of pairs with a common side, that are slit
    std::map<std::uint32_t, std::set<std::uint32_t>> vertices_of_surface_; ///< of the doubles
};

} // namespace

Differences check_images(const RoundedParts& parts, const Numbers& thinned, Violations& found) {
    if (parts.same_triangles) return {};
    return ImageChecks(parts, thinned, found)();
}

} // namespace terrane::verifier
