// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/structure/detail/parts.hpp>

namespace terrane {

using namespace structure::detail;

namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// An edge that is part of a line.
struct LineEdge {
    Edge ends{};
    std::uint32_t at = 0; ///< index of its triangles and patches in LineMaker's lists
};

class LineMaker {
public:
    LineMaker(const Mesh& mesh, const std::vector<std::uint32_t>& ranks, Structure& structure) :
        mesh_(mesh), ranks_(ranks), out_(structure) {}

    void operator()(const EdgeSides& edges) {
        find_edges(edges);
        find_ends();
        used_.assign(edges_.size(), false);
        for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v)
            if (is_corner_[v])
                for (const std::uint32_t e : edges_of(v)) trace(v, e);
        for (std::uint32_t e = 0; e < edges_.size(); ++e) trace(edges_[e].ends[0], e);
        sort_lines();
        number_corners();
        for (std::uint32_t l = 0; l < out_.lines.size(); ++l)
            for (const std::uint32_t p : out_.lines[l].patches) out_.patches[p].lines.push_back(l);
    }

private:
    void find_edges(const EdgeSides& all) {
        all.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            const auto part = [&](std::size_t i) { return out_.patch_of[sides[i].triangle]; };
            if (sides.size() == 2 &&
                out_.interface_of[sides[0].triangle] == out_.interface_of[sides[1].triangle])
                return;
            edges_.push_back({{low, high}, static_cast<std::uint32_t>(patches_.size())});
            std::vector<std::uint32_t> around;
            for (std::size_t i = 0; i < sides.size(); ++i) {
                triangles_.values.push_back(sides[i].triangle);
                around.push_back(part(i));
            }
            triangles_.close();
            std::sort(around.begin(), around.end());
            patches_.push_back(around);
        });
    }

    /// Lists the line edges of each vertex and finds corners.
    void find_ends() {
        starts_.assign(mesh_.vertices.size() + 1, 0);
        for (const LineEdge& e : edges_)
            for (const std::uint32_t v : e.ends) ++starts_[v + 1];
        for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
        at_vertex_.resize(2 * edges_.size());
        auto next = starts_;
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            for (const std::uint32_t v : edges_[e].ends) at_vertex_[next[v]++] = e;
        is_corner_.assign(mesh_.vertices.size(), false);
        for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
            const auto here = edges_of(v);
            if (here.empty()) continue;
            is_corner_[v] = here.size() != 2 || !same_patches(here[0], here[1]);
        }
    }

    [[nodiscard]] std::span<const std::uint32_t> edges_of(std::uint32_t v) const {
        return {at_vertex_.data() + starts_[v], at_vertex_.data() + starts_[v + 1]};
    }

    [[nodiscard]] bool same_patches(std::uint32_t e, std::uint32_t f) const {
        return std::ranges::equal(patches_[edges_[e].at], patches_[edges_[f].at]);
    }

    /// Follows the line from `v` across edge `e` to its other end, or around to `v`.
    void trace(std::uint32_t v, std::uint32_t e) {
        if (used_[e]) return;
        ModelLine line;
        describe(e, line);
        line.vertices.push_back(v);
        for (;;) {
            used_[e] = true;
            v = edges_[e].ends[0] == v ? edges_[e].ends[1] : edges_[e].ends[0];
            line.vertices.push_back(v);
            if (is_corner_[v] || v == line.vertices.front()) break;
            const auto here = edges_of(v);
            e = here[0] == e ? here[1] : here[0];
        }
        orient(line);
        for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i)
            line.length += distance(line.vertices[i], line.vertices[i + 1]);
        out_.lines.push_back(std::move(line));
    }

    /// Starts the line at its lesser end; a closed line at its least vertex, towards the lesser
    /// neighbour.
    void orient(ModelLine& line) const {
        auto& v = line.vertices;
        const auto less = [&](std::uint32_t a, std::uint32_t b) { return ranks_[a] < ranks_[b]; };
        if (v.front() != v.back()) {
            if (less(v.back(), v.front())) std::reverse(v.begin(), v.end());
            return;
        }
        if (!is_corner_[v.front()]) {
            v.pop_back();
            std::rotate(v.begin(), std::min_element(v.begin(), v.end(), less), v.end());
            v.push_back(v.front());
        }
        if (less(v[v.size() - 2], v[1])) std::reverse(v.begin(), v.end());
    }

    [[nodiscard]] double distance(std::uint32_t v, std::uint32_t w) const {
        return distance_between(mesh_.vertices[w], mesh_.vertices[v]);
    }

    /// All edges of a line have the same patches, so one edge determines its kind.
    void describe(std::uint32_t e, ModelLine& line) const {
        const auto patches = patches_[edges_[e].at];
        line.patches.assign(patches.begin(), patches.end());
        line.patches.erase(std::unique(line.patches.begin(), line.patches.end()),
                           line.patches.end());
        std::map<std::uint32_t, std::size_t> counts; // number of triangles here, by surface
        const auto triangles = triangles_[edges_[e].at];
        for (const std::uint32_t t : triangles)
            for (const std::uint32_t s : mesh_.surfaces_of[t]) ++counts[s];
        for (const auto& [surface, count] : counts) line.surfaces.push_back(surface);
        line.kind = triangles.size() == 1 ? LineKind::free_border : kind_of(counts);
    }

    [[nodiscard]] LineKind kind_of(const std::map<std::uint32_t, std::size_t>& counts) const {
        const auto has = [&](Role role) {
            return std::any_of(counts.begin(), counts.end(), [&](const auto& of_surface) {
                return mesh_.surfaces[of_surface.first].role == role;
            });
        };
        if (has(Role::boundary)) return LineKind::boundary;
        if (has(Role::horizon) && has(Role::fault)) return LineKind::cutoff;
        const bool faults = !has(Role::horizon) && !has(Role::unknown);
        const bool one_ends = std::any_of(counts.begin(), counts.end(), [](const auto& of_surface) {
            return of_surface.second == 1;
        });
        return faults && one_ends && counts.size() > 1 ? LineKind::branch : LineKind::intersection;
    }

    void sort_lines() {
        const auto rank_before = [&](std::uint32_t a, std::uint32_t b) {
            return ranks_[a] < ranks_[b];
        };
        std::sort(out_.lines.begin(), out_.lines.end(),
                  [&](const ModelLine& a, const ModelLine& b) {
                      return std::lexicographical_compare(a.vertices.begin(), a.vertices.end(),
                                                          b.vertices.begin(), b.vertices.end(),
                                                          rank_before);
                  });
    }

    void number_corners() {
        std::vector<std::uint32_t> vertices;
        for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v)
            if (is_corner_[v]) vertices.push_back(v);
        std::sort(vertices.begin(), vertices.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return ranks_[a] < ranks_[b]; });
        std::vector<std::uint32_t> number(mesh_.vertices.size(), none);
        for (const std::uint32_t v : vertices) {
            number[v] = static_cast<std::uint32_t>(out_.corners.size());
            out_.corners.push_back({VertexId(v), {}});
        }
        for (std::uint32_t l = 0; l < out_.lines.size(); ++l) {
            ModelLine& line = out_.lines[l];
            line.corners = {number[line.vertices.front()], number[line.vertices.back()]};
            for (const std::uint32_t c : line.corners)
                if (c != none) out_.corners[c].lines.push_back(l);
        }
    }

    const Mesh& mesh_;
    const std::vector<std::uint32_t>& ranks_;
    Structure& out_;
    std::vector<LineEdge> edges_;
    IndexLists<std::uint32_t> triangles_;  ///< per line edge
    IndexLists<std::uint32_t> patches_;    ///< per line edge: the patches of these triangles,
                                           ///< ascending
    std::vector<std::uint32_t> starts_;    ///< per vertex, and the total: index into at_vertex_
    std::vector<std::uint32_t> at_vertex_; ///< line edges
    std::vector<bool> is_corner_;          ///< per vertex
    std::vector<bool> used_;               ///< per line edge
};

} // namespace

std::string_view name_of(LineKind kind) {
    switch (kind) {
    case LineKind::free_border:
        return "free border";
    case LineKind::boundary:
        return "boundary line";
    case LineKind::cutoff:
        return "cutoff line";
    case LineKind::branch:
        return "branch line";
    default:
        return "intersection curve";
    }
}

namespace structure::detail {

void add_lines(const Mesh& mesh, const EdgeSides& edges, const std::vector<std::uint32_t>& ranks,
               Structure& structure) {
    LineMaker(mesh, ranks, structure)(edges);
}

} // namespace structure::detail
} // namespace terrane
