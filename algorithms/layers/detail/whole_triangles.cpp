// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/layers/detail/whole_triangles.hpp>

#include <algorithm>

#include <terrane/algorithms/core/disjoint_sets.hpp>

namespace terrane::layers::detail {

WholeTriangles::WholeTriangles(const Arrangement& arrangement, std::span<const Set> layers) :
    a_(arrangement) {
    find_parts();
    for (const Set& layer : layers) exclude_partly_used(layer);
    exclude_divided(layers);
}

/// Finds for each part its only input triangle (the first one of duplicates), if it has only one.
void WholeTriangles::find_parts() {
    whole_of_.assign(a_.triangles.size(), UINT32_MAX);
    parts_.assign(a_.state->corners.size(), {});
    is_whole_.assign(a_.state->corners.size(), true);
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t) {
        Set parents;
        for (const std::uint32_t p : a_.parents_of[t])
            parents.push_back(a_.inputs.first_same(InputTriangleId(p)));
        sort_unique(parents);
        if (parents.size() == 1) whole_of_[t] = parents[0];
        for (const std::uint32_t p : parents) {
            parts_[p].push_back(t);
            if (parents.size() > 1) is_whole_[p] = false;
        }
    }
}

void WholeTriangles::exclude_partly_used(const Set& layer) {
    std::vector<std::size_t> used(parts_.size(), 0);
    for (const std::uint32_t t : layer)
        if (whole_of_[t] != UINT32_MAX) ++used[whole_of_[t]];
    for (std::size_t p = 0; p < parts_.size(); ++p)
        if (used[p] > 0 && used[p] < parts_[p].size()) is_whole_[p] = false;
}

/// Excludes triangles that have a corner of adjacent parts on an edge: these stay divided, too.
void WholeTriangles::exclude_divided(std::span<const Set> layers) {
    Set used;
    for (const Set& layer : layers) used.insert(used.end(), layer.begin(), layer.end());
    sort_unique(used);
    std::vector<bool> needed(a_.vertices.size(), false);
    for (bool changed = true; changed;) {
        changed = false;
        for (const std::uint32_t t : used)
            if (!(*this)(t))
                for (const std::uint32_t v : a_.triangles[t]) needed[v] = true;
        for (const std::uint32_t t : used) {
            const auto whole = (*this)(t);
            if (!whole) continue;
            const Triangle& corners = a_.state->corners[*whole];
            for (const std::uint32_t v : a_.triangles[t]) {
                const bool own =
                    std::find(corners.begin(), corners.end(), a_.vertices[v]) != corners.end();
                if (own || !needed[v]) continue;
                is_whole_[*whole] = false;
                changed = true;
            }
        }
    }
}

} // namespace terrane::layers::detail
