// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <terrane/algorithms/verify/detail/coverage.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>
#include <terrane/algorithms/verify/verify_certificate.hpp>

namespace terrane {

namespace {

using verifier::Inputs;
using verifier::Numbers;
using verifier::SetAside;
using verifier::text;
using verifier::Vector4;
using verifier::Violations;

// --- R10: indices -----------------------------------------------------------------------------

void check_numbers(const Inputs& inputs, const RoundedClaim& rounded, Violations& found) {
    constexpr Rule rule = Rule::R10_rounded_indices;
    verifier::check_finite(rounded.vertices, "vertex", rule, found);
    verifier::check_corners(rounded.triangles, rounded.vertices.size(), rule, found);
    verifier::check_parents({rounded.triangles, rounded.parents_of}, inputs.triangles.size(), rule,
                            found);
    verifier::check_edge_list(rounded.intersection_edges, rounded.vertices.size(), rule, found);
    if (!verifier::sorted_and_unique(std::span(rounded.vanished)) ||
        !verifier::all_below(rounded.vanished, inputs.triangles.size()))
        found.push_back({rule, {}, "the vanished triangles are unsorted or out of range"});
    for (const double bound : {rounded.max_move, rounded.deviation})
        if (!std::isfinite(bound) || bound < 0)
            found.push_back({rule, {}, "a distance is negative or not finite"});
}

// --- R11: conforming --------------------------------------------------------------------------

void check_conforming(const RoundedClaim& rounded, Violations& found) {
    auto flaws = verify_conforming(rounded.vertices, rounded.triangles);
    if (!rounded.clean && flaws.empty())
        found.push_back(
            {Rule::R11_conforming, {}, "the doubles are conforming, but said not to be"});
    if (!rounded.clean) return;
    for (Violation& flaw : flaws)
        found.push_back({Rule::R11_conforming, std::move(flaw.elements), std::move(flaw.sentence)});
}

// --- R12: parents -----------------------------------------------------------------------------

void check_degenerate_parents(const IndexLists<std::uint32_t>& children, const SetAside& set_aside,
                              Violations& found) {
    for (const std::uint32_t t : set_aside.degenerate)
        for (const std::uint32_t child : children[t])
            found.push_back(
                {Rule::R12_rounded_parents,
                 {child, t},
                 "input triangle " + text(t) + " has no area, yet it is named as a parent"});
    for (const auto& [t, first] : set_aside.duplicates)
        if (!std::ranges::equal(children[t], children[first]))
            found.push_back({Rule::R12_rounded_parents,
                             {t},
                             "input triangles " + text(Edge{t, first}) +
                                 " are the same, but not the parents of the same triangles"});
}

void check_vanished(const Inputs& inputs, const IndexLists<std::uint32_t>& children,
                    const SetAside& set_aside, const RoundedClaim& rounded, Violations& found) {
    Numbers gone;
    for (std::uint32_t t = 0; t < inputs.triangles.size(); ++t)
        if (children[t].empty()) gone.push_back(t);
    Numbers vanished;
    std::ranges::set_difference(gone, set_aside.degenerate, std::back_inserter(vanished));
    verifier::for_each_missing(vanished, rounded.vanished, [&](std::uint32_t t) {
        found.push_back(
            {Rule::R12_rounded_parents,
             {t},
             "nothing is left of input triangle " + text(t) + ", but it is not listed"});
    });
    verifier::for_each_missing(rounded.vanished, vanished, [&](std::uint32_t t) {
        found.push_back({Rule::R12_rounded_parents,
                         {t},
                         "input triangle " + text(t) + " is listed as vanished, which it is not"});
    });
}

// --- R13, R14: distances ----------------------------------------------------------------------

/// The inputs, the vertices and the stated distances as integers of one scale.
struct Scaled {
    std::vector<Vector4> inputs, vertices;
    mpz_class max_move, deviation;
};

Scaled scale(const Inputs& inputs, const RoundedClaim& rounded) {
    std::vector<Point3> all = inputs.vertices;
    all.insert(all.end(), rounded.vertices.begin(), rounded.vertices.end());
    all.push_back({rounded.max_move, rounded.deviation, 0});
    auto points = verifier::scale_to_integers(all).points;
    Scaled scaled;
    scaled.max_move = points.back()[0];
    scaled.deviation = points.back()[1];
    points.pop_back();
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(inputs.vertices.size());
    scaled.inputs.assign(points.begin(), middle);
    scaled.vertices.assign(middle, points.end());
    return scaled;
}

/// Returns all pairs {parent, corner of one of its children}, sorted and unique.
std::vector<Edge> parents_and_corners(const RoundedClaim& rounded) {
    std::vector<Edge> pairs;
    for (std::size_t t = 0; t < rounded.triangles.size(); ++t)
        for (const std::uint32_t parent : rounded.parents_of[t])
            for (const std::uint32_t corner : rounded.triangles[t])
                pairs.push_back({parent, corner});
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

void check_deviation(const Inputs& inputs, const Scaled& scaled, const SetAside& set_aside,
                     const RoundedClaim& rounded, Violations& found) {
    for (const auto& [parent, vertex] : parents_and_corners(rounded)) {
        if (std::ranges::binary_search(set_aside.degenerate, parent)) continue; // R12
        const auto& [a, b, c] = inputs.triangles[parent];
        if (verifier::within(scaled.vertices[vertex],
                             {&scaled.inputs[a], &scaled.inputs[b], &scaled.inputs[c]},
                             scaled.deviation))
            continue;
        found.push_back({Rule::R13_deviation,
                         {vertex, parent},
                         "vertex " + text(vertex) + " is farther from input triangle " +
                             text(parent) + " than the stated deviation"});
    }
}

void check_moves(const Scaled& scaled, const ArrangementClaim& exact, const RoundedClaim& rounded,
                 Violations& found) {
    if (exact.triangles != rounded.triangles) return;
    const auto count = std::min(exact.vertices.size(), rounded.vertices.size());
    for (std::uint32_t v = 0; v < count; ++v) {
        const auto point = verifier::construct(exact.vertices[v], scaled.inputs);
        if (!point || verifier::within(*point, scaled.vertices[v], scaled.max_move)) continue;
        found.push_back({Rule::R14_moves,
                         {v},
                         "vertex " + text(v) +
                             " is farther from its exact point than the stated largest move"});
    }
    if (rounded.max_move > rounded.deviation)
        found.push_back(
            {Rule::R14_moves, {}, "the largest move is larger than the stated deviation"});
}

// --- R18: coverage ----------------------------------------------------------------------------

void check_coverage(const Inputs& inputs, const Scaled& scaled,
                    const IndexLists<std::uint32_t>& children, const SetAside& set_aside,
                    const RoundedClaim& rounded, Violations& found) {
    for (std::uint32_t parent = 0; parent < inputs.triangles.size(); ++parent) {
        if (children[parent].empty() || set_aside.first_of[parent] != parent ||
            std::ranges::binary_search(set_aside.degenerate, parent))
            continue; // R12
        const auto& [a, b, c] = inputs.triangles[parent];
        std::vector<Triangle> triangles;
        for (const std::uint32_t child : children[parent])
            triangles.push_back(rounded.triangles[child]);
        const verifier::Coverage coverage({&scaled.inputs[a], &scaled.inputs[b], &scaled.inputs[c]},
                                          scaled.vertices, scaled.deviation);
        if (coverage.holds(triangles)) continue;
        found.push_back({Rule::R18_coverage,
                         {parent},
                         "what is left of input triangle " + text(parent) + " has a hole"});
    }
}

// --- R16: regions -----------------------------------------------------------------------------

/// Disjoint sets; the lowest element of a set represents it.
class JoinedSets {
public:
    explicit JoinedSets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0U); }

    std::uint32_t find(std::uint32_t x) {
        while (up_[x] != x) x = up_[x] = up_[up_[x]];
        return x;
    }
    void join(std::uint32_t x, std::uint32_t y) {
        x = find(x);
        y = find(y);
        up_[std::max(x, y)] = std::min(x, y);
    }

private:
    Numbers up_;
};

/// Returns the surfaces of the parents of each triangle, sorted and unique.
IndexLists<std::uint32_t> surfaces_of_parents(const Inputs& inputs, const RoundedClaim& rounded) {
    IndexLists<std::uint32_t> surfaces;
    for (std::size_t t = 0; t < rounded.triangles.size(); ++t) {
        Numbers all;
        for (const std::uint32_t parent : rounded.parents_of[t])
            all.push_back(inputs.surface_of[parent]);
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        surfaces.push_back(all);
    }
    return surfaces;
}

/// Returns the two triangles at each edge that is not an intersection edge.
std::vector<std::array<std::uint32_t, 2>> joined_triangles(const RoundedClaim& rounded) {
    std::vector<std::pair<Edge, std::uint32_t>> sides;
    for (std::uint32_t t = 0; t < rounded.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& corners = rounded.triangles[t];
            const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
            sides.push_back({{low, high}, t});
        }
    std::sort(sides.begin(), sides.end());
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::size_t i = 1; i < sides.size(); ++i)
        if (sides[i - 1].first == sides[i].first &&
            !std::ranges::binary_search(rounded.intersection_edges, sides[i].first))
            pairs.push_back({sides[i - 1].second, sides[i].second});
    return pairs;
}

/// Joins the entries of two triangles in `surfaces` for each surface that they have in common.
void join_common(const IndexLists<std::uint32_t>& surfaces, std::uint32_t s, std::uint32_t t,
                 JoinedSets& sets) {
    for (std::uint32_t i = surfaces.offsets[s]; i < surfaces.offsets[s + 1]; ++i)
        for (std::uint32_t j = surfaces.offsets[t]; j < surfaces.offsets[t + 1]; ++j)
            if (surfaces.values[i] == surfaces.values[j]) sets.join(i, j);
}

void check_regions(const Inputs& inputs, const RoundedClaim& rounded, Violations& found) {
    if (!rounded.regions_of) return;
    const auto surfaces = surfaces_of_parents(inputs, rounded);
    if (rounded.regions_of->offsets != surfaces.offsets) {
        found.push_back(
            {Rule::R16_regions, {}, "there is not one region per triangle and surface"});
        return;
    }
    const Numbers& stated = rounded.regions_of->values;
    JoinedSets sets(stated.size());
    for (const auto& [s, t] : joined_triangles(rounded)) join_common(surfaces, s, t, sets);
    std::vector<std::array<std::uint32_t, 3>> regions; // {stated, true, triangle}
    for (std::uint32_t t = 0; t < surfaces.size(); ++t)
        for (std::uint32_t i = surfaces.offsets[t]; i < surfaces.offsets[t + 1]; ++i)
            regions.push_back({stated[i], sets.find(i), t});
    for (const std::size_t key :
         {0U, 1U}) { // equal stated regions have equal true ones, and vice versa
        std::ranges::sort(regions, {}, [key](const auto& r) {
            return std::array{r[key], r[1 - key], r[2]};
        });
        for (std::size_t i = 1; i < regions.size(); ++i)
            if (regions[i][key] == regions[i - 1][key] &&
                regions[i][1 - key] != regions[i - 1][1 - key])
                found.push_back({Rule::R16_regions,
                                 {regions[i - 1][2], regions[i][2]},
                                 "triangles " + text(Edge{regions[i - 1][2], regions[i][2]}) +
                                     (key == 0 ? " are not in one region" : " are in one region")});
    }
}

} // namespace

std::vector<Violation> verify_rounded(std::span<const Surface> surfaces,
                                      const ArrangementClaim& exact, const RoundedClaim& rounded) {
    Violations found;
    const Inputs inputs = verifier::join_inputs(surfaces, found);
    check_numbers(inputs, rounded, found);
    if (found.empty()) {
        const Scaled scaled = scale(inputs, rounded);
        const auto set_aside = verifier::find_set_aside(inputs, scaled.inputs);
        const auto children = verifier::children_of(rounded.parents_of, inputs.triangles.size());
        check_conforming(rounded, found);
        check_degenerate_parents(children, set_aside, found);
        check_vanished(inputs, children, set_aside, rounded, found);
        check_deviation(inputs, scaled, set_aside, rounded, found);
        check_moves(scaled, exact, rounded, found);
        check_coverage(inputs, scaled, children, set_aside, rounded, found);
        verifier::check_intersection_edges(
            verifier::find_intersection_edges({rounded.triangles, rounded.parents_of}, inputs,
                                              set_aside),
            rounded.intersection_edges, Rule::R15_rounded_edges, found);
        check_regions(inputs, rounded, found);
    }
    verifier::sort_by_rule(found);
    return found;
}

} // namespace terrane
