// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/restricted.hpp>

#include <algorithm>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/intersection_edges.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/kernel/assertion.hpp>

namespace terrane {
namespace {

IndexLists<std::uint32_t> kept_lists(const IndexLists<std::uint32_t>& lists,
                                     const std::vector<bool>& keep) {
    IndexLists<std::uint32_t> kept;
    for (std::size_t t = 0; t < keep.size(); ++t)
        if (keep[t]) kept.push_back(lists[t]);
    return kept;
}

template <class T>
std::vector<T> kept_values(const std::vector<T>& values, const std::vector<bool>& keep) {
    std::vector<T> kept;
    for (std::size_t t = 0; t < keep.size(); ++t)
        if (keep[t]) kept.push_back(values[t]);
    return kept;
}

void drop_unused_vertices(Arrangement& a, Adjacency& adjacency) {
    const VertexRenumbering numbers(used_vertices(a.vertices.size(), a.triangles));
    numbers.compact(a.vertices);
    numbers.rename(a.triangles);
    numbers.rename(adjacency.edges);
}

/// Labels triangles by patch, and those without a patch by surface. Triangles with several parents
/// get no label.
Labels labels_of(const Arrangement& a) {
    const InjectivePatches& in = a.state->patches;
    const auto patches = static_cast<std::uint32_t>(in.axis.size());
    Labels labels;
    labels.reserve(a.triangles.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        const std::uint32_t patch = in.of[t];
        const std::uint32_t label = patch != no_group ? patch : patches + a.surfaces_of[t][0];
        labels.push_back(a.parents_of[t].size() == 1 ? label : no_label);
    }
    return labels;
}

/// Keeps the pairs of input triangles that both have a part left.
void drop_neighbours_without_parts(const Arrangement& a, ExactState& state) {
    std::vector<bool> has_part(state.corners.size(), false);
    for (const std::uint32_t p : a.parents_of.values) has_part[p] = true;
    std::erase_if(state.neighbours, [&](const CandidatePair& p) {
        return !has_part[p.first] || !has_part[p.second];
    });
}

} // namespace

Arrangement restricted(Arrangement a, const std::vector<bool>& keep) {
    TERRANE_ASSERT(keep.size() == a.triangles.size());
    if (std::find(keep.begin(), keep.end(), false) == keep.end()) return a;
    ExactState& state = own_state(a);
    state.whole = false;
    state.adjacency = adjacency_of_kept(state.adjacency, labels_of(a), a.triangles, keep);
    a.triangles = kept_values(a.triangles, keep);
    state.patches.of = kept_values(state.patches.of, keep);
    a.parents_of = kept_lists(a.parents_of, keep);
    a.surfaces_of = kept_lists(a.surfaces_of, keep);
    drop_unused_vertices(a, state.adjacency);
    drop_neighbours_without_parts(a, state);
    a.intersection_edges = find_intersection_edges(state.adjacency, a.inputs, a.parents_of);
    return a;
}

} // namespace terrane
