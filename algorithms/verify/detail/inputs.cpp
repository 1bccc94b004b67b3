// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/inputs.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>

namespace terrane::verifier {

Inputs join_inputs(std::span<const Surface> surfaces, Violations& found) {
    Inputs inputs;
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        const auto offset = static_cast<std::uint32_t>(inputs.vertices.size());
        for (Triangle t : surfaces[s].triangles) {
            if (all_below(t, surfaces[s].vertices.size())) {
                for (std::uint32_t& corner : t) corner += offset;
            } else {
                const auto number = static_cast<std::uint32_t>(inputs.triangles.size());
                found.push_back(
                    {Rule::R1_indices,
                     {number},
                     "input triangle " + text(number) + " names a vertex that does not exist"});
                t = {};
            }
            inputs.triangles.push_back(t);
            inputs.surface_of.push_back(s);
        }
        inputs.vertices.insert(inputs.vertices.end(), surfaces[s].vertices.begin(),
                               surfaces[s].vertices.end());
    }
    check_finite(inputs.vertices, "input vertex", Rule::R1_indices, found);
    return inputs;
}

SetAside find_set_aside(const Inputs& inputs, std::span<const Vector4> points) {
    SetAside result;
    result.first_of.resize(inputs.triangles.size());
    std::iota(result.first_of.begin(), result.first_of.end(), 0U);
    std::map<std::array<Vector4, 3>, std::uint32_t> first_with;
    for (std::uint32_t t = 0; t < inputs.triangles.size(); ++t) {
        const auto [a, b, c] = inputs.triangles[t];
        const Vector4 plane = orthogonal(points[a], points[b], points[c]);
        if (!projection_axis(plane)) {
            result.degenerate.push_back(t);
            continue;
        }
        std::array<Vector4, 3> corners{points[a], points[b], points[c]};
        std::sort(corners.begin(), corners.end());
        result.first_of[t] = first_with.try_emplace(std::move(corners), t).first->second;
        if (result.first_of[t] != t) result.duplicates.push_back({t, result.first_of[t]});
    }
    return result;
}

IndexLists<std::uint32_t> children_of(const IndexLists<std::uint32_t>& parents_of,
                                      std::size_t input_count) {
    IndexLists<std::uint32_t> children;
    children.offsets.assign(input_count + 1, 0);
    children.values.resize(parents_of.values.size());
    for (const std::uint32_t parent : parents_of.values) ++children.offsets[parent + 1];
    std::partial_sum(children.offsets.begin(), children.offsets.end(), children.offsets.begin());
    Numbers next = children.offsets;
    for (std::uint32_t t = 0; t < parents_of.size(); ++t) {
        for (const std::uint32_t parent : parents_of[t]) children.values[next[parent]++] = t;
    }
    return children;
}

IndexLists<std::uint32_t> surfaces_of_parents(const Numbers& surface_of,
                                              const IndexLists<std::uint32_t>& parents_of) {
    IndexLists<std::uint32_t> surfaces_of;
    for (std::size_t t = 0; t < parents_of.size(); ++t) {
        Numbers surfaces;
        for (const std::uint32_t parent : parents_of[t]) surfaces.push_back(surface_of[parent]);
        make_set(surfaces);
        surfaces_of.push_back(surfaces);
    }
    return surfaces_of;
}

namespace {

/// {surface, number of geometrically distinct parents in it}, sorted.
using Signature = std::vector<std::array<std::uint32_t, 2>>;

Signature signature(std::span<const std::uint32_t> parents, const Inputs& inputs,
                    const SetAside& set_aside) {
    std::vector<std::array<std::uint32_t, 2>> different; // {surface, first triangle of its kind}
    for (const std::uint32_t parent : parents) {
        different.push_back({inputs.surface_of[parent], set_aside.first_of[parent]});
    }
    make_set(different);
    Signature result;
    for (const auto& [surface, first] : different) {
        if (result.empty() || result.back()[0] != surface) result.push_back({surface, 0});
        ++result.back()[1];
    }
    return result;
}

} // namespace

std::vector<Edge> find_intersection_edges(const Parts& parts, const Inputs& inputs,
                                          const SetAside& set_aside) {
    const auto signature_of = [&](std::uint32_t triangle) {
        return signature(parts.parents_of[triangle], inputs, set_aside);
    };
    auto sides = half_edges(parts.triangles);
    const auto same = [](const HalfEdge& a, const HalfEdge& b) { // in a triangle without area
        return a.edge == b.edge && a.triangle == b.triangle;
    };
    sides.erase(std::unique(sides.begin(), sides.end(), same), sides.end());
    std::vector<Edge> edges;
    for_each_edge(sides, [&](std::span<const HalfEdge> at) {
        if (at.size() > 2 ||
            (at.size() == 2 && signature_of(at[0].triangle) != signature_of(at[1].triangle)))
            edges.push_back(at[0].edge);
    });
    return edges;
}

void check_intersection_edges(const std::vector<Edge>& truth, const std::vector<Edge>& listed,
                              Rule rule, Violations& found) {
    compare_lists(truth, listed, [&](const Edge& edge, bool is_listed) {
        found.push_back({rule,
                         {edge[0], edge[1]},
                         "the edge of vertices " + text(edge) +
                             (is_listed ? " is listed, but no intersection edge"
                                        : " is an intersection edge, but not listed")});
    });
}

} // namespace terrane::verifier
