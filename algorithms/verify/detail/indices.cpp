// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/indices.hpp>

#include <cmath>

namespace terrane::verifier {

bool all_below(std::span<const std::uint32_t> values, std::size_t count) {
    return std::all_of(values.begin(), values.end(), [count](auto value) { return value < count; });
}

bool well_formed(const IndexLists<std::uint32_t>& lists, std::size_t count) {
    const Numbers& offsets = lists.offsets;
    return offsets.size() == count + 1 && offsets.front() == 0 &&
           offsets.back() == lists.values.size() && std::is_sorted(offsets.begin(), offsets.end());
}

void check_finite(std::span<const Point3> vertices, const std::string& name, Rule rule,
                  Violations& found) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const Point3& p = vertices[v];
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
        found.push_back({rule, {v}, name + " " + text(v) + " is not finite"});
    }
}

void check_corners(std::span<const Triangle> triangles, std::size_t vertex_count, Rule rule,
                   Violations& found) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (all_below(triangles[t], vertex_count)) continue;
        found.push_back({rule, {t}, "triangle " + text(t) + " names a vertex that does not exist"});
    }
}

void check_parents(const Parts& parts, std::size_t input_triangles, Rule rule, Violations& found) {
    if (!well_formed(parts.parents_of, parts.triangles.size())) {
        found.push_back({rule, {}, "there is not one list of parents per triangle"});
        return;
    }
    for (std::uint32_t t = 0; t < parts.triangles.size(); ++t) {
        const auto parents = parts.parents_of[t];
        if (!parents.empty() && sorted_and_unique(parents) && all_below(parents, input_triangles))
            continue;
        found.push_back(
            {rule,
             {t},
             "the parents of triangle " + text(t) + " are missing, unsorted or out of range"});
    }
}

void check_edge_list(std::span<const Edge> edges, std::size_t vertex_count, Rule rule,
                     Violations& found) {
    if (!sorted_and_unique(edges))
        found.push_back({rule, {}, "the intersection edges are unsorted"});
    for (const Edge& e : edges) {
        if (e[0] < e[1] && e[1] < vertex_count) continue;
        found.push_back(
            {rule,
             {e[0], e[1]},
             "the intersection edge of vertices " + text(e) + " is out of range or out of order"});
    }
}

void check_limit(double limit, std::uint32_t surface, double accepted, Rule rule,
                 Violations& found) {
    const std::string name = "the limit of surface " + text(surface);
    if (!std::isfinite(limit) || limit < 0)
        found.push_back({rule, {surface}, name + " is negative or not finite"});
    else if (limit > accepted)
        found.push_back(
            {Rule::R26_limits, {surface}, name + " is larger than the largest that is accepted"});
}

} // namespace terrane::verifier
