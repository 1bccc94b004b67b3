// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/extension_faces.hpp>

#include <algorithm>
#include <set>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>

namespace terrane {
namespace {

Edge common_edge(const Triangle& t, const Triangle& u) {
    Edge edge{};
    std::size_t n = 0;
    for (const std::uint32_t v : t)
        if (n < 2 && std::find(u.begin(), u.end(), v) != u.end()) edge[n++] = v;
    if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
    return edge;
}

class Cells {
public:
    Cells(const Arrangement& a, std::span<const ExtensionTriangle> strips, std::vector<bool> keep) :
        a_(a), strips_(strips), by_input_(strips_by_input(a, strips)),
        strip_of_(strips_by_triangle(a, by_input_)), keep_(std::move(keep)),
        sets_(a.triangles.size()), is_open_(a.triangles.size(), false) {}

    std::vector<bool> operator()() {
        for (std::uint32_t t = 0; t < strip_of_.size(); ++t)
            if (strip_of_[t] != no_index) keep_[t] = false;
        list_edges();
        join();
        do grow();
        while (close() || part_loose());
        return std::move(keep_);
    }

private:
    /// An edge with a strip triangle at it.
    struct StripEdgeSides {
        Edge edge;
        std::vector<std::uint32_t> triangles;
    };

    [[nodiscard]] bool is_strip(std::uint32_t t) const { return strip_of_[t] != no_index; }

    void list_edges() {
        for (const auto& list : a_.state->adjacency.inner)
            for (const auto& [t, u] : list)
                if (is_strip(t) || is_strip(u))
                    edges_.push_back({common_edge(a_.triangles[t], a_.triangles[u]), {t, u}});
        for (std::size_t e = 0; e < a_.state->adjacency.edges.size(); ++e) {
            const auto at = a_.state->adjacency.triangles_at[e];
            if (std::any_of(at.begin(), at.end(), [&](auto t) { return is_strip(t); }))
                edges_.push_back({a_.state->adjacency.edges[e], {at.begin(), at.end()}});
        }
    }

    [[nodiscard]] bool are_one_strip(std::uint32_t t, std::uint32_t u) const {
        return is_strip(t) && is_strip(u) &&
               strips_[strip_of_[t]].surface == strips_[strip_of_[u]].surface;
    }

    void join() {
        for (const StripEdgeSides& e : edges_) {
            if (e.triangles.size() != 2) continue;
            const auto [t, u] = std::pair(e.triangles[0], e.triangles[1]);
            if (are_one_strip(t, u) && strips_[strip_of_[t]].piece == strips_[strip_of_[u]].piece)
                sets_.join(t, u);
        }
    }

    /// Keeps the cells connected to the border, as far as they are closed.
    void grow() {
        for (std::uint32_t t = 0; t < strip_of_.size(); ++t)
            if (is_strip(t)) keep_[t] = false;
        std::vector<bool> reached(strip_of_.size(), false); // per cell
        for (bool changed = true; changed;) {
            changed = false;
            for (const StripEdgeSides& e : edges_) {
                if (e.triangles.size() != 2) continue;
                for (unsigned i = 0; i < 2; ++i)
                    changed = reach(e.triangles[i], e.triangles[1 - i], reached) || changed;
            }
        }
        for (std::uint32_t t = 0; t < strip_of_.size(); ++t)
            if (is_strip(t)) keep_[t] = reached[sets_.find(t)];
    }

    /// Reaches the cell of t across the edge with `from`. Returns whether it is new.
    bool reach(std::uint32_t t, std::uint32_t from, std::vector<bool>& reached) {
        if (!is_strip(t) || reached[sets_.find(t)] || is_open_[sets_.find(t)]) return false;
        const bool comes = is_strip(from)
                               ? are_one_strip(t, from) && reached[sets_.find(from)]
                               : keep_[from] && !strips_[strip_of_[t]].is_fan && shares(t, from);
        if (comes) reached[sets_.find(t)] = true;
        return comes;
    }

    /// Tells whether the other triangle belongs to the surface of the strip triangle.
    [[nodiscard]] bool shares(std::uint32_t t, std::uint32_t of) const {
        const auto list = a_.surfaces_of[of];
        return std::binary_search(list.begin(), list.end(), strips_[strip_of_[t]].surface);
    }

    /// Marks kept cells with free edges as open. Returns whether there are any.
    bool close() {
        const UpwardRounding guard;
        bool any = false;
        for (const StripEdgeSides& e : edges_) {
            std::uint32_t left = no_index;
            std::size_t count = 0;
            for (const std::uint32_t t : e.triangles) {
                if (!keep_[t]) continue;
                left = t;
                ++count;
            }
            if (count != 1 || !is_strip(left) || is_side(guard, left, e.edge)) continue;
            is_open_[sets_.find(left)] = true;
            any = true;
        }
        return any;
    }

    // ---- What closes a gap

    [[nodiscard]] bool share_surface(std::uint32_t t, std::uint32_t u) const {
        const auto of = a_.surfaces_of[t];
        return std::any_of(of.begin(), of.end(), [&](std::uint32_t s) { return is_in(u, s); });
    }
    [[nodiscard]] bool is_in(std::uint32_t t, std::uint32_t surface) const {
        const auto of = a_.surfaces_of[t];
        return std::binary_search(of.begin(), of.end(), surface);
    }
    /// Tells whether a triangle lies in a surface not only because of strips.
    [[nodiscard]] bool is_given_for(std::uint32_t t, std::uint32_t surface) const {
        const auto parents = a_.parents_of[t];
        return std::any_of(parents.begin(), parents.end(), [&](std::uint32_t p) {
            return by_input_[p] == no_index && p >= a_.inputs.first[surface] &&
                   p < a_.inputs.first[surface + 1];
        });
    }
    /// Tells whether a surface as it was given ends at the edge.
    [[nodiscard]] bool ends_at(const StripEdgeSides& e, std::uint32_t surface) const {
        std::size_t given = 0, kept = 0;
        for (const std::uint32_t t : e.triangles) {
            if (!is_given_for(t, surface)) continue;
            ++given;
            kept += keep_[t] ? 1 : 0;
        }
        return given == 1 && kept == 1;
    }
    /// Tells whether the edge lies on a side of one of the strip's triangles that contain it.
    [[nodiscard]] bool is_on_outline(UpwardWitness upward, std::uint32_t t,
                                     const Edge& edge) const {
        const auto parents = a_.parents_of[t];
        return std::any_of(parents.begin(), parents.end(), [&](std::uint32_t p) {
            const Triangle& c = a_.state->corners[p];
            for (std::size_t k = 0; k < 3; ++k)
                if (lies_on(upward, a_, edge, InputTriangleId(p), c[k], c[(k + 1) % 3]))
                    return true;
            return false;
        });
    }
    /// Tells whether a strip triangle ends on a kept one at an edge: on another surface, on its own
    /// one where that does not end, or on another strip by which it was cut.
    [[nodiscard]] bool ends_on(UpwardWitness upward, std::uint32_t t, std::uint32_t on,
                               const StripEdgeSides& e) const {
        if (is_strip(on) && share_surface(t, on))
            return a_.parents_of[t][0] != a_.parents_of[on][0] &&
                   !is_on_outline(upward, t, e.edge) && !is_on_outline(upward, on, e.edge);
        const auto of = a_.surfaces_of[t];
        return std::any_of(of.begin(), of.end(),
                           [&](std::uint32_t s) { return !is_given_for(on, s) || !ends_at(e, s); });
    }

    /// Finds the bridges that join two parts of the border of their own surface, given the
    /// components of kept strips: a triangle is attached along the border, and its opposite corner
    /// is an end of another edge along which its component is attached.
    void mark_joining(UpwardWitness upward, DisjointSets& connected, std::vector<bool>& ends) {
        struct Attached {
            std::uint32_t triangle;
            PointIndex opposite;
        };
        std::vector<Attached> all;
        std::set<std::pair<std::uint32_t, PointIndex>> corners; // by component
        for (const StripEdgeSides& e : edges_)
            for (const std::uint32_t t : e.triangles) {
                if (!is_strip(t) || !keep_[t] || !is_given_beside(e, t)) continue;
                for (const std::uint32_t p : a_.parents_of[t]) {
                    const Triangle& c = a_.state->corners[p];
                    for (unsigned k = 0; k < 3; ++k) {
                        if (!strips_[by_input_[p]].joins[k] ||
                            !lies_on(upward, a_, e.edge, InputTriangleId(p), c[k], c[(k + 1) % 3]))
                            continue;
                        all.push_back({t, c[(k + 2) % 3]});
                        for (const std::uint32_t v : e.edge)
                            corners.emplace(connected.find(t), a_.vertices[v]);
                    }
                }
            }
        for (const Attached& at : all)
            if (corners.contains({connected.find(at.triangle), at.opposite}))
                ends[at.triangle] = true;
    }
    /// Tells whether a kept triangle at the edge lies in the surface of a strip's triangle, and not
    /// only because of strips.
    [[nodiscard]] bool is_given_beside(const StripEdgeSides& e, std::uint32_t strip) const {
        return std::any_of(e.triangles.begin(), e.triangles.end(), [&](std::uint32_t t) {
            return keep_[t] && is_given_for(t, strips_[strip_of_[strip]].surface);
        });
    }

    /// Marks kept cells as open that are connected with none that ends on a surface, or joins two
    /// parts of a border: they lead from the border to the border. Returns whether there are any.
    bool part_loose() {
        const UpwardRounding guard;
        DisjointSets connected(strip_of_.size());
        std::vector<bool> ends(strip_of_.size(), false), is_closing(strip_of_.size(), false);
        for (const StripEdgeSides& e : edges_)
            for (const std::uint32_t t : e.triangles)
                for (const std::uint32_t u : e.triangles) {
                    if (t == u || !is_strip(t) || !keep_[t] || !keep_[u]) continue;
                    if (is_strip(u) && share_surface(t, u)) connected.join(t, u);
                    ends[t] = ends[t] || ends_on(guard, t, u, e);
                }
        mark_joining(guard, connected, ends);
        for (std::uint32_t t = 0; t < ends.size(); ++t)
            if (ends[t]) is_closing[connected.find(t)] = true;
        bool any = false;
        for (std::uint32_t t = 0; t < ends.size(); ++t) {
            if (!is_strip(t) || !keep_[t] || is_closing[connected.find(t)]) continue;
            is_open_[sets_.find(t)] = true;
            any = true;
        }
        return any;
    }

    /// Tells whether the edge lies on the side of a quadrilateral.
    [[nodiscard]] bool is_side(UpwardWitness upward, std::uint32_t t, const Edge& edge) const {
        for (const std::uint32_t p : a_.parents_of[t]) {
            const ExtensionTriangle& strip = strips_[by_input_[p]];
            const Triangle& c = a_.state->corners[p];
            for (unsigned k = 0; k < 3; ++k)
                if (strip.is_side(k) &&
                    lies_on(upward, a_, edge, InputTriangleId(p), c[k], c[(k + 1) % 3]))
                    return true;
        }
        return false;
    }

    const Arrangement& a_;
    std::span<const ExtensionTriangle> strips_;
    std::vector<std::uint32_t> by_input_;
    std::vector<std::uint32_t> strip_of_; ///< per triangle of the arrangement
    std::vector<bool> keep_;
    std::vector<StripEdgeSides> edges_;
    DisjointSets sets_;         ///< of triangles: cells
    std::vector<bool> is_open_; ///< per cell
};

} // namespace

std::vector<std::uint32_t> strips_by_input(const Arrangement& a,
                                           std::span<const ExtensionTriangle> strips) {
    const auto& first = a.inputs.first;
    std::vector<std::uint32_t> count(a.surfaces.size(), 0);
    for (const ExtensionTriangle& t : strips) ++count[t.surface];
    std::vector<std::uint32_t> next(count.size());
    for (std::size_t s = 0; s < count.size(); ++s) next[s] = first[s + 1] - count[s];
    std::vector<std::uint32_t> by_input(a.state->corners.size(), no_index);
    for (std::uint32_t i = 0; i < strips.size(); ++i) by_input[next[strips[i].surface]++] = i;
    return by_input;
}

std::vector<std::uint32_t> strips_by_triangle(const Arrangement& a,
                                              std::span<const std::uint32_t> by_input) {
    std::vector<std::uint32_t> of(a.triangles.size(), no_index);
    for (std::uint32_t t = 0; t < of.size(); ++t) {
        const auto parents = a.parents_of[t];
        if (std::all_of(parents.begin(), parents.end(),
                        [&](std::uint32_t p) { return by_input[p] != no_index; }))
            of[t] = by_input[parents[0]];
    }
    return of;
}

std::vector<bool> kept_cells(const Arrangement& arrangement,
                             std::span<const ExtensionTriangle> strips, std::vector<bool> keep) {
    return Cells(arrangement, strips, std::move(keep))();
}

} // namespace terrane
