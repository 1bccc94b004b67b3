// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/intersection_edges.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>

namespace terrane {

IndexLists<std::uint32_t> surfaces_of_parents(const InputTriangles& inputs,
                                              const IndexLists<std::uint32_t>& parents_of,
                                              const Run& run) {
    IndexLists<std::uint32_t> surfaces;
    if (parents_of.values.size() == parents_of.size()) { // one parent each
        surfaces.offsets = parents_of.offsets;
        surfaces.values.resize(parents_of.size());
        for_ranges(parents_of.size(), run, [&](std::size_t first, std::size_t last) {
            std::uint32_t s = 0; // usually the surface of the previous triangle
            for (std::size_t t = first; t < last; ++t) {
                const std::uint32_t p = parents_of.values[t];
                if (p < inputs.first[s] || p >= inputs.first[s + 1])
                    s = inputs.surface_of(InputTriangleId(p));
                surfaces.values[t] = s;
            }
        });
        return surfaces;
    }
    surfaces.offsets.reserve(parents_of.offsets.size());
    surfaces.values.reserve(parents_of.values.size());
    std::uint32_t s = 0;
    for (std::size_t t = 0; t < parents_of.size(); ++t) {
        bool any = false;
        for (const std::uint32_t p : parents_of[t]) { // parents ascend, and so do their surfaces
            const bool same = inputs.first[s] <= p && p < inputs.first[s + 1];
            if (any && same) continue;
            if (!same) s = inputs.surface_of(InputTriangleId(p));
            surfaces.values.push_back(s);
            any = true;
        }
        surfaces.close();
    }
    return surfaces;
}

namespace {

/// Compares the parents of two triangles as intersection edges require.
class Signatures {
public:
    Signatures(const InputTriangles& inputs, const IndexLists<std::uint32_t>& parents_of) :
        inputs_(inputs), parents_of_(parents_of) {
        if (parents_of.values.size() == parents_of.size()) return; // each triangle has one parent
        table_.reserve(inputs.first.back());
        for (std::uint32_t s = 0; s + 1 < inputs.first.size(); ++s)
            for (std::uint32_t p = inputs.first[s]; p < inputs.first[s + 1]; ++p)
                table_.push_back({s, p});
        for (const auto& [p, same] : inputs.duplicates) table_[p][1] = same;
    }

    [[nodiscard]] bool agree(std::uint32_t s, std::uint32_t t) {
        const auto p = parents_of_[s], q = parents_of_[t];
        if (std::ranges::equal(p, q)) return true;
        if (p.size() == 1 && q.size() == 1)
            return inputs_.surface_of(InputTriangleId(p[0])) ==
                   inputs_.surface_of(InputTriangleId(q[0]));
        list_distinct(p, first_);
        list_distinct(q, second_);
        return std::ranges::equal(first_, second_, {}, surface_of, surface_of);
    }

private:
    /// A parent: its surface and the first triangle that is the same.
    using Parent = std::array<std::uint32_t, 2>;

    static std::uint32_t surface_of(const Parent& p) { return p[0]; }

    void list_distinct(std::span<const std::uint32_t> parents, std::vector<Parent>& distinct) {
        distinct.clear();
        for (const std::uint32_t p : parents) distinct.push_back(table_[p]);
        sort_unique(distinct);
    }

    const InputTriangles& inputs_;
    const IndexLists<std::uint32_t>& parents_of_;
    std::vector<Parent> table_; ///< per input triangle, if a triangle has several parents
    std::vector<Parent> first_, second_;
};

} // namespace

std::vector<Edge> find_intersection_edges(const Adjacency& adjacency, const InputTriangles& inputs,
                                          const IndexLists<std::uint32_t>& parents_of) {
    Signatures signatures(inputs, parents_of);
    std::vector<Edge> found;
    for (std::size_t e = 0; e < adjacency.edges.size(); ++e) {
        const auto sides = adjacency.triangles_at[e];
        if (sides.size() > 2 || (sides.size() == 2 && !signatures.agree(sides[0], sides[1])))
            found.push_back(adjacency.edges[e]);
    }
    return found;
}

} // namespace terrane
