// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include <terrane/algorithms/verify_contacts.hpp>
#include <terrane/algorithms/verify_partition.hpp>
#include <terrane/algorithms/verify_rational.hpp>

namespace terrane {

namespace {

using verifier::ExactMesh;
using verifier::Partition;
using verifier::Vector4;

using Numbers = std::vector<std::uint32_t>;
using Violations = std::vector<Violation>;

std::string text(std::uint64_t number) {
    return std::to_string(number);
}

std::string text(Edge pair) {
    return text(pair[0]) + " and " + text(pair[1]);
}

/// The inputs as one, in numbers that count through all surfaces.
struct Inputs {
    std::vector<Point3> vertices;
    std::vector<Triangle> triangles; ///< indices into vertices
    Numbers surface_of;              ///< per triangle
};

/// What rule R8 is about, computed from the inputs alone.
struct SetAside {
    Numbers degenerate;                                   ///< sorted
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {triangle, first}, sorted
    Numbers first_of; ///< per input triangle: the first with the same points, mostly itself
};

void sort_by_rule(Violations& violations) {
    std::sort(violations.begin(), violations.end(), [](const Violation& a, const Violation& b) {
        return std::tie(a.rule, a.elements, a.sentence) < std::tie(b.rule, b.elements, b.sentence);
    });
}

// --- R1: indices ------------------------------------------------------------------------------

template <class T>
bool sorted_and_unique(std::span<const T> values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

bool all_below(std::span<const std::uint32_t> values, std::size_t count) {
    return std::all_of(values.begin(), values.end(), [count](auto value) { return value < count; });
}

bool finite(const Point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void check_finite(std::span<const Point3> vertices, const std::string& name, Violations& found) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        if (finite(vertices[v])) continue;
        found.push_back({Rule::R1_indices, {v}, name + " " + text(v) + " is not finite"});
    }
}

void check_corners(std::span<const Triangle> triangles, std::size_t vertex_count,
                   Violations& found) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (all_below(triangles[t], vertex_count)) continue;
        found.push_back(
            {Rule::R1_indices, {t}, "triangle " + text(t) + " names a vertex that does not exist"});
    }
}

/// Joins the surfaces; a triangle with an index out of range is reported, with corners 0, 0, 0.
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
    check_finite(inputs.vertices, "input vertex", found);
    return inputs;
}

/// How many of its indices a construction uses; none if its kind or axis does not exist.
std::optional<std::size_t> used_indices(const Construction& construction) {
    switch (construction.kind) {
    case Construction::Kind::input:
        return 1;
    case Construction::Kind::line_plane:
        return 5;
    case Construction::Kind::three_planes:
        return 9;
    case Construction::Kind::line_line:
        if (construction.axis <= Axis::z) return 4;
    }
    return std::nullopt;
}

void check_constructions(const ArrangementClaim& claim, std::size_t input_vertices,
                         Violations& found) {
    for (std::uint32_t v = 0; v < claim.vertices.size(); ++v) {
        const auto used = used_indices(claim.vertices[v]);
        if (used && all_below(std::span(claim.vertices[v].v).first(*used), input_vertices))
            continue;
        found.push_back({Rule::R1_indices,
                         {v},
                         "vertex " + text(v) + " names an input vertex that does not exist"});
    }
}

bool well_formed(const Lists<std::uint32_t>& lists, std::size_t count) {
    const Numbers& offsets = lists.offsets;
    return offsets.size() == count + 1 && offsets.front() == 0 &&
           offsets.back() == lists.values.size() && std::is_sorted(offsets.begin(), offsets.end());
}

void check_parents(const ArrangementClaim& claim, std::size_t input_triangles, Violations& found) {
    if (!well_formed(claim.parents_of, claim.triangles.size())) {
        found.push_back({Rule::R1_indices, {}, "there is not one list of parents per triangle"});
        return;
    }
    for (std::uint32_t t = 0; t < claim.triangles.size(); ++t) {
        const auto parents = claim.parents_of[t];
        if (parents.empty() || !sorted_and_unique(parents) ||
            !all_below(parents, input_triangles)) {
            found.push_back(
                {Rule::R1_indices,
                 {t},
                 "the parents of triangle " + text(t) + " are none, unsorted or out of range"});
        }
    }
}

void check_edge_list(const ArrangementClaim& claim, Violations& found) {
    if (!sorted_and_unique(std::span(claim.intersection_edges))) {
        found.push_back({Rule::R1_indices, {}, "the intersection edges are unsorted"});
    }
    for (const Edge& e : claim.intersection_edges) {
        if (e[0] < e[1] && e[1] < claim.vertices.size()) continue;
        found.push_back(
            {Rule::R1_indices,
             {e[0], e[1]},
             "the intersection edge of vertices " + text(e) + " is out of range or out of order"});
    }
}

void check_set_aside_lists(const ArrangementClaim& claim, std::size_t input_triangles,
                           Violations& found) {
    if (!sorted_and_unique(std::span(claim.degenerate)) ||
        !all_below(claim.degenerate, input_triangles)) {
        found.push_back(
            {Rule::R1_indices, {}, "the degenerate triangles are unsorted or out of range"});
    }
    const bool in_range =
        std::all_of(claim.duplicates.begin(), claim.duplicates.end(),
                    [&](const auto& duplicate) { return all_below(duplicate, input_triangles); });
    if (!in_range || !sorted_and_unique(std::span(claim.duplicates))) {
        found.push_back({Rule::R1_indices, {}, "the duplicates are unsorted or out of range"});
    }
}

void check_indices(const ArrangementClaim& claim, const Inputs& inputs, Violations& found) {
    check_constructions(claim, inputs.vertices.size(), found);
    check_corners(claim.triangles, claim.vertices.size(), found);
    check_parents(claim, inputs.triangles.size(), found);
    check_edge_list(claim, found);
    check_set_aside_lists(claim, inputs.triangles.size(), found);
}

// --- R2, R3, R4: vertices and triangles -------------------------------------------------------

/// The points of the claim; where one is undefined, a violation.
std::vector<Vector4> construct_all(const ArrangementClaim& claim, std::span<const Vector4> inputs,
                                   Violations& found) {
    std::vector<Vector4> points;
    points.reserve(claim.vertices.size());
    for (std::uint32_t v = 0; v < claim.vertices.size(); ++v) {
        auto point = verifier::construct(claim.vertices[v], inputs);
        if (!point) {
            found.push_back({Rule::R2_vertices,
                             {v},
                             "the construction of vertex " + text(v) + " is undefined"});
        }
        points.push_back(point ? std::move(*point) : Vector4{});
    }
    return points;
}

/// The numbers of the items, equal ones side by side and then ascending.
template <class T>
Numbers sorted_numbers(std::span<const T> items) {
    Numbers order(items.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (items[a] != items[b]) return items[a] < items[b];
        return a < b;
    });
    return order;
}

void check_distinct(const ExactMesh& mesh, Violations& found) {
    const Numbers order = sorted_numbers(std::span(mesh.points));
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (mesh.points[order[i - 1]] != mesh.points[order[i]]) continue;
        const Edge pair{order[i - 1], order[i]};
        found.push_back({Rule::R3_distinct,
                         {pair[0], pair[1]},
                         "vertices " + text(pair) + " are the same point"});
    }
    std::vector<bool> used(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) used[corner] = true;
    }
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (used[v]) continue;
        found.push_back({Rule::R3_distinct, {v}, "vertex " + text(v) + " belongs to no triangle"});
    }
}

void check_triangles(const ExactMesh& mesh, Violations& found) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (verifier::projection_axis(mesh.planes[t])) continue;
        found.push_back({Rule::R4_triangles, {t}, "triangle " + text(t) + " has no area"});
    }
    std::vector<Triangle> sets = mesh.triangles;
    for (Triangle& t : sets) std::sort(t.begin(), t.end());
    const Numbers order = sorted_numbers(std::span<const Triangle>(sets));
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (sets[order[i - 1]] != sets[order[i]]) continue;
        const Edge pair{order[i - 1], order[i]};
        found.push_back({Rule::R4_triangles,
                         {pair[0], pair[1]},
                         "triangles " + text(pair) + " have the same vertices"});
    }
}

// --- R5: contacts -----------------------------------------------------------------------------

void check_contacts(const ExactMesh& mesh, Violations& found) {
    for (const Edge& pair : verifier::find_improper_pairs(mesh, most_contacts_listed)) {
        found.push_back(
            {Rule::R5_contacts,
             {pair[0], pair[1]},
             "triangles " + text(pair) + " meet other than in shared corners or edges"});
    }
}

/// The rules that speak of the mesh alone.
void check_mesh(const ExactMesh& mesh, Violations& found) {
    check_distinct(mesh, found);
    check_triangles(mesh, found);
    check_contacts(mesh, found);
}

// --- R6: parents ------------------------------------------------------------------------------

/// Per input triangle, the triangles that name it as a parent, sorted.
Lists<std::uint32_t> children_of(const Lists<std::uint32_t>& parents_of, std::size_t input_count) {
    Lists<std::uint32_t> children;
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

void check_partition(std::uint32_t parent, std::span<const std::uint32_t> children,
                     const Partition& partition, const ExactMesh& mesh, Violations& found) {
    bool all_inside = true;
    for (const std::uint32_t child : children) {
        if (partition.holds(mesh.triangles[child])) continue;
        all_inside = false;
        found.push_back({Rule::R6_parents,
                         {parent, child},
                         "triangle " + text(child) +
                             " does not lie within its parent, input triangle " + text(parent)});
    }
    if (all_inside && !partition.areas_add_up(children)) {
        found.push_back({Rule::R6_parents,
                         {parent},
                         "the triangles that name input triangle " + text(parent) +
                             " as a parent do not have its area"});
    }
}

/// Checks one input triangle that is neither degenerate nor a duplicate.
void check_first(std::uint32_t parent, std::span<const std::uint32_t> children,
                 const std::array<const Vector4*, 3>& corners, const ExactMesh& mesh,
                 Violations& found) {
    if (children.empty()) {
        found.push_back({Rule::R6_parents,
                         {parent},
                         "no triangle names input triangle " + text(parent) + " as a parent"});
        return;
    }
    check_partition(parent, children, Partition(corners, mesh), mesh, found);
}

void check_set_aside_parents(const SetAside& set_aside, const Lists<std::uint32_t>& children,
                             Violations& found) {
    for (const std::uint32_t t : set_aside.degenerate) {
        if (children[t].empty()) continue;
        found.push_back(
            {Rule::R6_parents,
             {t},
             "input triangle " + text(t) + " has no area, yet it is named as a parent"});
    }
    for (const auto& [t, first] : set_aside.duplicates) {
        const auto a = children[t];
        const auto b = children[first];
        if (std::equal(a.begin(), a.end(), b.begin(), b.end())) continue;
        found.push_back({Rule::R6_parents,
                         {t, first},
                         "input triangles " + text(Edge{t, first}) +
                             " are the same, but not the parents of the same triangles"});
    }
}

void check_all_parents(const Inputs& inputs, std::span<const Vector4> input_points,
                       const SetAside& set_aside, const ArrangementClaim& claim,
                       const ExactMesh& mesh, Violations& found) {
    const auto children = children_of(claim.parents_of, inputs.triangles.size());
    check_set_aside_parents(set_aside, children, found);
    std::size_t next_degenerate = 0;
    for (std::uint32_t t = 0; t < inputs.triangles.size(); ++t) {
        if (next_degenerate < set_aside.degenerate.size() &&
            set_aside.degenerate[next_degenerate] == t) {
            ++next_degenerate;
            continue;
        }
        if (set_aside.first_of[t] != t) continue;
        const Triangle& corners = inputs.triangles[t];
        check_first(
            t, children[t],
            {&input_points[corners[0]], &input_points[corners[1]], &input_points[corners[2]]}, mesh,
            found);
    }
}

// --- R7: intersection edges -------------------------------------------------------------------

/// {surface, the number of different parents in it}, sorted.
using Signature = std::vector<std::array<std::uint32_t, 2>>;

Signature signature(std::span<const std::uint32_t> parents, const Inputs& inputs,
                    const SetAside& set_aside) {
    std::vector<std::array<std::uint32_t, 2>> different; // {surface, first triangle of its kind}
    for (const std::uint32_t parent : parents) {
        different.push_back({inputs.surface_of[parent], set_aside.first_of[parent]});
    }
    std::sort(different.begin(), different.end());
    different.erase(std::unique(different.begin(), different.end()), different.end());
    Signature result;
    for (const auto& [surface, first] : different) {
        if (result.empty() || result.back()[0] != surface) result.push_back({surface, 0});
        ++result.back()[1];
    }
    return result;
}

struct EdgeUse {
    Edge edge;
    std::uint32_t triangle;

    friend bool operator==(const EdgeUse&, const EdgeUse&) = default;
};

/// All edges of all triangles, sorted and unique.
std::vector<EdgeUse> edge_uses(std::span<const Triangle> triangles) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
            uses.push_back({{low, high}, t});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle);
    });
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end()); // of a triangle without area
    return uses;
}

std::vector<Edge> find_intersection_edges(const Inputs& inputs, const SetAside& set_aside,
                                          const ArrangementClaim& claim) {
    const auto signature_of = [&](std::uint32_t triangle) {
        return signature(claim.parents_of[triangle], inputs, set_aside);
    };
    const std::vector<EdgeUse> uses = edge_uses(claim.triangles);
    std::vector<Edge> edges;
    for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
        while (last < uses.size() && uses[last].edge == uses[first].edge) ++last;
        const std::size_t count = last - first;
        if (count > 2 || (count == 2 && signature_of(uses[first].triangle) !=
                                            signature_of(uses[first + 1].triangle))) {
            edges.push_back(uses[first].edge);
        }
    }
    return edges;
}

/// Calls `visit` with each value that is in `of` and not in `in`. Both are sorted.
template <class T, class Visit>
void for_each_missing(const std::vector<T>& of, const std::vector<T>& in, Visit visit) {
    std::vector<T> missing;
    std::set_difference(of.begin(), of.end(), in.begin(), in.end(), std::back_inserter(missing));
    std::for_each(missing.begin(), missing.end(), visit);
}

void check_intersection_edges(const Inputs& inputs, const SetAside& set_aside,
                              const ArrangementClaim& claim, Violations& found) {
    const std::vector<Edge> edges = find_intersection_edges(inputs, set_aside, claim);
    const auto report = [&](const Edge& edge, const std::string& what) {
        found.push_back({Rule::R7_intersection_edges,
                         {edge[0], edge[1]},
                         "the edge of vertices " + text(edge) + what});
    };
    for_each_missing(edges, claim.intersection_edges, [&](const Edge& edge) {
        report(edge, " is an intersection edge, but not listed");
    });
    for_each_missing(claim.intersection_edges, edges, [&](const Edge& edge) {
        report(edge, " is listed, but no intersection edge");
    });
}

// --- R8: set aside ----------------------------------------------------------------------------

SetAside find_set_aside(const Inputs& inputs, std::span<const Vector4> points) {
    SetAside result;
    result.first_of.resize(inputs.triangles.size());
    std::iota(result.first_of.begin(), result.first_of.end(), 0U);
    std::map<std::array<Vector4, 3>, std::uint32_t> first_with;
    for (std::uint32_t t = 0; t < inputs.triangles.size(); ++t) {
        const auto [a, b, c] = inputs.triangles[t];
        const Vector4 plane = verifier::orthogonal(points[a], points[b], points[c]);
        if (!verifier::projection_axis(plane)) {
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

void check_set_aside(const SetAside& truth, const ArrangementClaim& claim, Violations& found) {
    for_each_missing(truth.degenerate, claim.degenerate, [&](std::uint32_t t) {
        found.push_back({Rule::R8_set_aside,
                         {t},
                         "input triangle " + text(t) + " has no area, but is not listed as such"});
    });
    for_each_missing(claim.degenerate, truth.degenerate, [&](std::uint32_t t) {
        found.push_back({Rule::R8_set_aside,
                         {t},
                         "input triangle " + text(t) + " is listed as degenerate, but has area"});
    });
    using Duplicate = std::array<std::uint32_t, 2>;
    for_each_missing(truth.duplicates, claim.duplicates, [&](const Duplicate& pair) {
        found.push_back({Rule::R8_set_aside,
                         {pair[0], pair[1]},
                         "input triangle " + text(pair[0]) + " is a duplicate of " + text(pair[1]) +
                             ", but not listed as such"});
    });
    for_each_missing(claim.duplicates, truth.duplicates, [&](const Duplicate& pair) {
        found.push_back({Rule::R8_set_aside,
                         {pair[0], pair[1]},
                         "input triangle " + text(pair[0]) + " is listed as a duplicate of " +
                             text(pair[1]) + ", whose first it is not"});
    });
}

} // namespace

std::vector<Violation> verify_arrangement(std::span<const Surface> inputs,
                                          const ArrangementClaim& claim) {
    Violations found;
    const Inputs joined = join_inputs(inputs, found);
    check_indices(claim, joined, found);
    if (found.empty()) {
        const auto [input_points, scale] = verifier::scale_to_integers(joined.vertices);
        auto points = construct_all(claim, input_points, found);
        if (found.empty()) {
            const auto mesh = verifier::make_exact_mesh(std::move(points), scale, claim.triangles);
            const auto set_aside = find_set_aside(joined, input_points);
            check_mesh(mesh, found);
            check_all_parents(joined, input_points, set_aside, claim, mesh, found);
            check_intersection_edges(joined, set_aside, claim, found);
            check_set_aside(set_aside, claim, found);
        }
    }
    sort_by_rule(found);
    return found;
}

std::vector<Violation> verify_conforming(std::span<const Point3> vertices,
                                         std::span<const Triangle> triangles) {
    Violations found;
    check_finite(vertices, "vertex", found);
    check_corners(triangles, vertices.size(), found);
    if (found.empty()) {
        auto [points, scale] = verifier::scale_to_integers(vertices);
        check_mesh(verifier::make_exact_mesh(std::move(points), scale, triangles), found);
    }
    sort_by_rule(found);
    return found;
}

} // namespace terrane
