// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/verify/detail/cut.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane {

namespace {

using verifier::Inputs;
using verifier::Numbers;
using verifier::RoundedParts;
using verifier::text;
using verifier::Violations;

// --- R10: indices -----------------------------------------------------------------------------

void check_rounded_numbers(const Inputs& inputs, const RoundedClaim& rounded, Violations& found) {
    constexpr Rule rule = Rule::R10_rounded_indices;
    verifier::check_finite(rounded.vertices, "vertex", rule, found);
    verifier::check_corners(rounded.triangles, rounded.vertices.size(), rule, found);
    verifier::check_parents({rounded.triangles, rounded.parents_of}, inputs.triangles.size(), rule,
                            found);
    verifier::check_edge_list(rounded.intersection_edges, rounded.vertices.size(), rule, found);
    if (!verifier::sorted_and_unique(std::span(rounded.vanished)) ||
        !verifier::all_below(rounded.vanished, inputs.triangles.size()))
        found.push_back({rule, {}, "the vanished triangles are unsorted or out of range"});
    for (const double bound : {rounded.max_move.value_or(0), rounded.deviation})
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

void check_degenerate_parents(const RoundedParts& parts, Violations& found) {
    for (const std::uint32_t t : parts.set_aside.degenerate)
        for (const std::uint32_t child : parts.children[t])
            found.push_back(
                {Rule::R12_rounded_parents,
                 {child, t},
                 "input triangle " + text(t) + " has no area, yet it is named as a parent"});
    for (const auto& [t, first] : parts.set_aside.duplicates)
        if (!std::ranges::equal(parts.children[t], parts.children[first]))
            found.push_back({Rule::R12_rounded_parents,
                             {t},
                             "input triangles " + text(Edge{t, first}) +
                                 " are the same, but not the parents of the same triangles"});
}

/// Checks the list of input triangles with area that have no children.
void check_vanished_list(const RoundedParts& parts, Violations& found) {
    const Numbers& listed = parts.rounded.vanished;
    Numbers gone;
    for (std::uint32_t t = 0; t < parts.inputs.triangles.size(); ++t)
        if (parts.exact_children[t].empty()) {
            for (const std::uint32_t child : parts.children[t])
                found.push_back({Rule::R12_rounded_parents,
                                 {child, t},
                                 "input triangle " + text(t) +
                                     " is no parent in the exact part, yet it is named as one"});
        } else if (parts.children[t].empty()) {
            gone.push_back(t);
        }
    Numbers vanished;
    std::ranges::set_difference(gone, parts.set_aside.degenerate, std::back_inserter(vanished));
    verifier::compare_lists(vanished, listed, [&](std::uint32_t t, bool is_listed) {
        found.push_back(
            {Rule::R12_rounded_parents,
             {t},
             is_listed
                 ? "input triangle " + text(t) + " is listed as vanished, which it is not"
                 : "nothing is left of input triangle " + text(t) + ", but it is not listed"});
    });
}

// --- R13, R14: what is stated about distances -------------------------------------------------

/// Returns a number with three digits, for sentences, as the program writes it: 3.3e-6, not 3.3e-06.
std::string decimal(double number) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number,
                                   std::chars_format::general, 3);
    std::string out(text.data(), end.ptr);
    if (const auto e = out.find('e'); e != std::string::npos && out[e + 2] == '0')
        out.erase(e + 2, 1);
    return out;
}

/// Checks the stated distances against each other and the largest that is accepted; returns whether
/// the deviation is not above that.
bool check_stated(const RoundedParts& parts, double accepted, Violations& found) {
    const RoundedClaim& rounded = parts.rounded;
    if (rounded.max_move.has_value() != parts.same_triangles)
        found.push_back({Rule::R14_moves,
                         {},
                         rounded.max_move ? "a largest move is stated, but the triangles are not "
                                            "those of the exact part"
                                          : "the largest move is not stated"});
    if (rounded.max_move.value_or(0) > rounded.deviation)
        found.push_back(
            {Rule::R14_moves, {}, "the largest move is larger than the stated deviation"});
    if (rounded.deviation <= accepted) return true;
    found.push_back({Rule::R13_deviation,
                     {},
                     "the stated deviation, " + decimal(rounded.deviation) +
                         ", is larger than the largest that is accepted, " + decimal(accepted)});
    return false;
}

void check_all(const RoundedParts& parts, double accepted, Verdict& verdict) {
    Violations& found = verdict.violations;
    check_conforming(parts.rounded, found);
    check_degenerate_parents(parts, found);
    check_vanished_list(parts, found);
    if (check_stated(parts, accepted, found)) {
        const auto [deviation, partly] = verifier::check_distances(parts, found);
        verdict.measured =
            Measured{deviation,     accepted, parts.rounded.vanished.size(),
                     partly.size(), false,    verifier::check_images(parts, partly, found)};
    }
    verifier::check_rounded_orientation(parts, found);
    verifier::check_intersection_edges(
        verifier::find_intersection_edges({parts.rounded.triangles, parts.rounded.parents_of},
                                          parts.inputs, parts.set_aside),
        parts.rounded.intersection_edges, Rule::R15_rounded_edges, found);
    verifier::check_regions(parts, found);
}

} // namespace

Verdict verify_rounded(std::span<const Surface> surfaces, const ArrangementClaim& exact,
                       const RoundedClaim& rounded, const VerifyOptions& options) {
    const StandardArithmetic arithmetic;
    return verifier::verify_rounded_part(surfaces, exact, rounded, options, {});
}

Verdict verifier::verify_rounded_part(std::span<const Surface> surfaces,
                                      const ArrangementClaim& exact, const RoundedClaim& rounded,
                                      const VerifyOptions& options, std::vector<bool> is_cut) {
    Verdict verdict;
    const Inputs inputs = verifier::join_inputs(surfaces, verdict.violations);
    check_rounded_numbers(inputs, rounded, verdict.violations);
    if (verdict.violations.empty()) {
        const double accepted =
            options.max_deviation.value_or(verifier::default_max_deviation(inputs));
        RoundedParts parts = verifier::make_rounded_parts(inputs, exact, rounded);
        parts.is_cut = std::move(is_cut);
        if (std::isfinite(accepted)) parts.accepted = mpq_class(accepted) * parts.scale;
        check_all(parts, accepted, verdict);
        if (parts.same_triangles && rounded.clean && verdict.violations.empty()) {
            const std::size_t turned = verifier::check_places(
                verifier::exact_mesh_of(surfaces, exact),
                verifier::make_exact_mesh(parts.points, parts.scale, rounded.triangles),
                verdict.violations);
            verdict.measured->differences.turned = turned;
            verdict.measured->same_cells = turned == 0 && verdict.violations.empty();
        }
    }
    verifier::sort_by_rule(verdict.violations);
    return verdict;
}

} // namespace terrane
