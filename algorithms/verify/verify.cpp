// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/verify.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/meetings.hpp>
#include <terrane/algorithms/verify/detail/partition.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane {

namespace {

using verifier::all_below;
using verifier::ExactMesh;
using verifier::Inputs;
using verifier::Numbers;
using verifier::Partition;
using verifier::SetAside;
using verifier::sorted_and_unique;
using verifier::text;
using verifier::Vector4;
using verifier::Violations;

// --- R1: indices ------------------------------------------------------------------------------

/// Returns the number of indices that a construction uses; none if its kind or axis does not exist.
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
    constexpr Rule rule = Rule::R1_indices;
    verifier::check_corners(claim.triangles, claim.vertices.size(), rule, found);
    verifier::check_parents({claim.triangles, claim.parents_of}, inputs.triangles.size(), rule,
                            found);
    verifier::check_edge_list(claim.intersection_edges, claim.vertices.size(), rule, found);
    check_set_aside_lists(claim, inputs.triangles.size(), found);
}

// --- R2, R3, R4: vertices and triangles -------------------------------------------------------

/// Constructs the points of the claim and reports those that are undefined.
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

/// Calls visit(pair) for equal items, each with the next one.
template <class T, class Visit>
void for_each_equal_pair(std::span<const T> items, const Visit& visit) {
    Numbers order(items.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        verifier::look_for_stop();
        if (items[a] != items[b]) return items[a] < items[b];
        return a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (items[order[i - 1]] == items[order[i]]) visit(Edge{order[i - 1], order[i]});
}

void check_distinct(const ExactMesh& mesh, Violations& found) {
    for_each_equal_pair(std::span(mesh.points), [&](const Edge& pair) {
        found.push_back({Rule::R3_distinct,
                         {pair[0], pair[1]},
                         "vertices " + text(pair) + " are the same point"});
    });
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
    for_each_equal_pair(std::span<const Triangle>(sets), [&](const Edge& pair) {
        found.push_back({Rule::R4_triangles,
                         {pair[0], pair[1]},
                         "triangles " + text(pair) + " have the same vertices"});
    });
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

/// Checks the rules about the mesh itself.
void check_mesh(const ExactMesh& mesh, Violations& found) {
    check_distinct(mesh, found);
    check_triangles(mesh, found);
    check_contacts(mesh, found);
}

// --- R6: parents ------------------------------------------------------------------------------

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

void check_set_aside_parents(const SetAside& set_aside, const IndexLists<std::uint32_t>& children,
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
    const auto children = verifier::children_of(claim.parents_of, inputs.triangles.size());
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

// --- R8: set aside ----------------------------------------------------------------------------

void check_set_aside(const SetAside& truth, const ArrangementClaim& claim, Violations& found) {
    verifier::compare_lists(
        truth.degenerate, claim.degenerate, [&](std::uint32_t t, bool is_listed) {
            found.push_back({Rule::R8_set_aside,
                             {t},
                             "input triangle " + text(t) +
                                 (is_listed ? " is listed as degenerate, but has area"
                                            : " has no area, but is not listed as such")});
        });
    verifier::compare_lists(
        truth.duplicates, claim.duplicates, [&](const Edge& pair, bool is_listed) {
            found.push_back({Rule::R8_set_aside,
                             {pair[0], pair[1]},
                             "input triangle " + text(pair[0]) +
                                 (is_listed ? " is listed as a duplicate of " + text(pair[1]) +
                                                  ", whose first it is not"
                                            : " is a duplicate of " + text(pair[1]) +
                                                  ", but not listed as such")});
        });
}

/// Tells whether a violation leaves open which input triangles contain a vertex.
bool breaks_structure(const Violation& violation) {
    return violation.rule >= Rule::R3_distinct && violation.rule <= Rule::R6_parents;
}

} // namespace

std::string name_of(Rule rule) {
    return "R" + text(static_cast<std::uint64_t>(rule) + 1);
}

std::vector<Violation> verify_arrangement(std::span<const Surface> inputs,
                                          const ArrangementClaim& claim) {
    const StandardArithmetic arithmetic;
    Violations found;
    const Inputs joined = verifier::join_inputs(inputs, found);
    check_indices(claim, joined, found);
    if (found.empty()) {
        const auto [input_points, scale] = verifier::scale_to_integers(joined.vertices);
        auto points = construct_all(claim, input_points, found);
        if (found.empty()) {
            const auto mesh = verifier::make_exact_mesh(std::move(points), scale, claim.triangles);
            const auto set_aside = verifier::find_set_aside(joined, input_points);
            check_mesh(mesh, found);
            check_all_parents(joined, input_points, set_aside, claim, mesh, found);
            verifier::check_intersection_edges(
                verifier::find_intersection_edges({claim.triangles, claim.parents_of}, joined,
                                                  set_aside),
                claim.intersection_edges, Rule::R7_intersection_edges, found);
            check_set_aside(set_aside, claim, found);
            const verifier::ExactParts parts{joined, input_points, set_aside, claim, mesh};
            verifier::check_orientation(parts, found);
            if (std::ranges::none_of(found, breaks_structure))
                verifier::check_meetings(parts, found);
        }
    }
    verifier::sort_by_rule(found);
    return found;
}

std::vector<Violation> verify_conforming(std::span<const Point3> vertices,
                                         std::span<const Triangle> triangles) {
    const StandardArithmetic arithmetic;
    Violations found;
    verifier::check_finite(vertices, "vertex", Rule::R1_indices, found);
    verifier::check_corners(triangles, vertices.size(), Rule::R1_indices, found);
    if (found.empty()) {
        auto [points, scale] = verifier::scale_to_integers(vertices);
        check_mesh(verifier::make_exact_mesh(std::move(points), scale, triangles), found);
    }
    verifier::sort_by_rule(found);
    return found;
}

} // namespace terrane
