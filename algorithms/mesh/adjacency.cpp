// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/adjacency.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/parallel.hpp>

namespace terrane {
namespace {

bool is_inner(std::uint32_t label, std::uint32_t other) {
    return label == other && label != no_label;
}

void add_edge(Adjacency& a, const Edge& edge, std::span<const std::uint32_t> triangles) {
    a.edges.push_back(edge);
    a.triangles_at.push_back(triangles);
}

/// Returns the edge that two triangles have in common; they must share two corners and no more.
Edge common_edge(const Triangle& t, const Triangle& u) {
    std::array<std::uint32_t, 2> ends{};
    std::size_t count = 0;
    for (const std::uint32_t v : t)
        if (count < 2 && (v == u[0] || v == u[1] || v == u[2])) ends[count++] = v;
    return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

/// Marks in `is_new` the vertices of the triangles that are not in the old mesh. Returns these
/// triangles and all that may share an edge with one of them, ascending.
std::vector<std::uint32_t> triangles_near_new(const Divided& divided, std::vector<char>& is_new,
                                              const Run& run) {
    const std::size_t count = divided.triangles.size();
    std::vector<char> is_kept(count, 0);
    for_ranges(divided.unchanged_as.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f)
            if (divided.unchanged_as[f] != no_index) is_kept[divided.unchanged_as[f]] = 1;
    });
    for (std::size_t t = 0; t < count; ++t)
        if (is_kept[t] == 0)
            for (const std::uint32_t v : divided.triangles[t]) is_new[v] = 1;
    return concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
        count, run, [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> part;
            for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
                const Triangle& c = divided.triangles[t];
                if (is_kept[t] == 0 || is_new[c[0]] + is_new[c[1]] + is_new[c[2]] > 1)
                    part.push_back(t);
            }
            return part;
        }));
}

/// Returns the adjacency of all edges whose two ends are marked in `is_new`.
Adjacency edges_of_new(const Divided& divided, const Labels& old_labels,
                       std::span<const std::uint32_t> near, const std::vector<char>& is_new,
                       const Run& run) {
    // Only the marked vertices are numbered, in their order; all others share one number.
    const auto vertices = concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
        is_new.size(), run, [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> part;
            for (auto v = static_cast<std::uint32_t>(first); v < last; ++v)
                if (is_new[v] != 0) part.push_back(v);
            return part;
        }));
    UninitializedVector<std::uint32_t> number_of;
    number_of.resize(is_new.size());
    for (std::uint32_t k = 0; k < vertices.size(); ++k) number_of[vertices[k]] = k;
    const auto other =
        static_cast<std::uint32_t>(vertices.size()); // at most one corner of a triangle
    std::vector<Triangle> corners(near.size());
    Labels labels(near.size());
    for_ranges(near.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const Triangle& c = divided.triangles[near[k]];
            for (unsigned i = 0; i < 3; ++i)
                corners[k][i] = is_new[c[i]] != 0 ? number_of[c[i]] : other;
            const auto faces = divided.faces_of[near[k]];
            labels[k] = faces.size() == 1 ? old_labels[faces[0]] : no_label;
        }
    });
    Adjacency a;
    Adjacency::Inner& inner = a.inner.emplace_back();
    std::vector<std::uint32_t> triangles;
    group_edges(corners, vertices.size() + 1, run)
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (high == other) return;
            triangles.clear();
            for (const auto& s : sides) triangles.push_back(near[s.triangle]);
            if (sides.size() == 2 && is_inner(labels[sides[0].triangle], labels[sides[1].triangle]))
                inner.push_back({triangles[0], triangles[1]});
            else
                add_edge(a, {vertices[low], vertices[high]}, triangles);
        });
    return a;
}

/// Appends edges that all come after those of `a`.
void append(Adjacency& a, Adjacency b) {
    std::move(b.inner.begin(), b.inner.end(), std::back_inserter(a.inner));
    a.edges.insert(a.edges.end(), b.edges.begin(), b.edges.end());
    for (std::size_t e = 0; e < b.edges.size(); ++e) a.triangles_at.push_back(b.triangles_at[e]);
}

/// Merges the edges of another part of the mesh into `a`.
void merge(Adjacency& a, Adjacency b) {
    std::move(b.inner.begin(), b.inner.end(), std::back_inserter(a.inner));
    if (b.edges.empty()) return;
    Adjacency all;
    for (std::size_t i = 0, j = 0; i < a.edges.size() || j < b.edges.size();) {
        const bool first = j == b.edges.size() || (i < a.edges.size() && a.edges[i] < b.edges[j]);
        all.edges.push_back(first ? a.edges[i] : b.edges[j]);
        all.triangles_at.push_back(first ? a.triangles_at[i++] : b.triangles_at[j++]);
    }
    a.edges = std::move(all.edges);
    a.triangles_at = std::move(all.triangles_at);
}

} // namespace

Labels labels_of(const IndexLists<std::uint32_t>& surfaces_of,
                 const IndexLists<std::uint32_t>& parents_of) {
    Labels labels;
    labels.reserve(surfaces_of.size());
    for (std::size_t t = 0; t < surfaces_of.size(); ++t)
        labels.push_back(parents_of[t].size() == 1 ? surfaces_of[t][0] : no_label);
    return labels;
}

Adjacency adjacency_of(const EdgeSides& edges, const Labels& labels) {
    Adjacency a;
    Adjacency::Inner& inner = a.inner.emplace_back();
    inner.reserve(edges.sides.size() / 2);
    std::vector<std::uint32_t> triangles;
    edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        if (sides.size() == 2 && is_inner(labels[sides[0].triangle], labels[sides[1].triangle])) {
            inner.push_back({sides[0].triangle, sides[1].triangle});
            return;
        }
        triangles.clear();
        for (const auto& s : sides) triangles.push_back(s.triangle);
        add_edge(a, {low, high}, triangles);
    });
    return a;
}

Adjacency adjacency_after(const EdgeSides& old, const Labels& old_labels, const Divided& divided,
                          const Run& run) {
    std::vector<char> is_new(divided.vertex_count, 0);
    const auto near = triangles_near_new(divided, is_new, run);
    const auto kept_edges = [&](std::size_t first, std::size_t last) {
        Adjacency a;
        Adjacency::Inner& inner = a.inner.emplace_back();
        inner.reserve((old.starts[last] - old.starts[first]) / 2);
        std::vector<std::uint32_t> triangles;
        old.for_each(first, last, [&](std::uint32_t low, std::uint32_t high, auto sides) {
            const std::uint32_t named = divided.vertex_map[low];
            // All triangles at an edge between two marked vertices are near a new one.
            if (is_new[named] != 0 && is_new[divided.vertex_map[high]] != 0) return;
            const auto kept = [&](std::size_t i) {
                return divided.unchanged_as[sides[i].triangle];
            };
            if (sides.size() == 2 &&
                is_inner(old_labels[sides[0].triangle], old_labels[sides[1].triangle])) {
                inner.push_back({kept(0), kept(1)});
                return;
            }
            triangles.clear();
            for (std::size_t i = 0; i < sides.size(); ++i) triangles.push_back(kept(i));
            add_edge(a, {named, divided.vertex_map[high]}, triangles);
        });
        return a;
    };
    auto parts = parts_of_ranges<Adjacency>(old.starts.size() - 1, run, kept_edges);
    Adjacency all = std::move(parts.front());
    for (std::size_t k = 1; k < parts.size(); ++k) append(all, std::move(parts[k]));
    merge(all, edges_of_new(divided, old_labels, near, is_new, run));
    return all;
}

Adjacency adjacency_of_kept(const Adjacency& all, const Labels& labels,
                            std::span<const Triangle> triangles, const std::vector<bool>& keep) {
    std::vector<std::uint32_t> number(keep.size(), no_index);
    std::uint32_t next = 0;
    for (std::size_t t = 0; t < keep.size(); ++t)
        if (keep[t]) number[t] = next++;
    Adjacency kept;
    std::vector<std::pair<Edge, std::uint32_t>> alone; // triangles whose neighbours are gone
    for (const Adjacency::Inner& list : all.inner) {
        Adjacency::Inner& inner = kept.inner.emplace_back();
        for (const auto& [t, u] : list)
            if (keep[t] && keep[u])
                inner.push_back({number[t], number[u]});
            else if (keep[t] || keep[u])
                alone.emplace_back(common_edge(triangles[t], triangles[u]),
                                   number[keep[t] ? t : u]);
    }
    Adjacency::Inner& inner = kept.inner.emplace_back(); // of edges where others are gone
    std::vector<std::uint32_t> here, numbers;
    for (std::size_t e = 0; e < all.edges.size(); ++e) {
        here.clear();
        numbers.clear();
        for (const std::uint32_t t : all.triangles_at[e]) {
            if (!keep[t]) continue;
            here.push_back(t);
            numbers.push_back(number[t]);
        }
        if (here.size() == 2 && is_inner(labels[here[0]], labels[here[1]]))
            inner.push_back({numbers[0], numbers[1]});
        else if (!here.empty())
            add_edge(kept, all.edges[e], numbers);
    }
    std::ranges::sort(alone);
    Adjacency borders;
    for (const auto& [edge, t] : alone) add_edge(borders, edge, std::span(&t, 1));
    merge(kept, std::move(borders));
    return kept;
}

} // namespace terrane
