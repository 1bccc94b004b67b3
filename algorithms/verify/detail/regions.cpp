// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_regions of rounded_parts.hpp.
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

namespace {

/// Returns the two triangles at each edge that is not an intersection edge.
std::vector<std::array<std::uint32_t, 2>> joined_triangles(const RoundedClaim& rounded) {
    const auto sides = half_edges(rounded.triangles);
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::size_t i = 1; i < sides.size(); ++i)
        if (sides[i - 1].edge == sides[i].edge &&
            !std::ranges::binary_search(rounded.intersection_edges, sides[i].edge))
            pairs.push_back({sides[i - 1].triangle, sides[i].triangle});
    return pairs;
}

/// Joins the entries of two triangles in `surfaces` for each surface that they have in common.
void join_common(const IndexLists<std::uint32_t>& surfaces, std::uint32_t s, std::uint32_t t,
                 JoinedSets& sets) {
    for (std::uint32_t i = surfaces.offsets[s]; i < surfaces.offsets[s + 1]; ++i)
        for (std::uint32_t j = surfaces.offsets[t]; j < surfaces.offsets[t + 1]; ++j)
            if (surfaces.values[i] == surfaces.values[j]) sets.join(i, j);
}

} // namespace

void check_regions(const RoundedParts& parts, Violations& found) {
    const RoundedClaim& rounded = parts.rounded;
    const auto surfaces = surfaces_of_parents(parts.inputs.surface_of, rounded.parents_of);
    if (!well_formed(rounded.regions_of, rounded.triangles.size()) ||
        rounded.regions_of.offsets != surfaces.offsets) {
        found.push_back(
            {Rule::R16_regions, {}, "there is not one region per triangle and surface"});
        return;
    }
    const Numbers& stated = rounded.regions_of.values;
    JoinedSets sets(stated.size());
    for (const auto& [s, t] : joined_triangles(rounded)) join_common(surfaces, s, t, sets);
    // The lowest entry of a region is that of its lowest triangle.
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> number_of; // by surface and lowest entry
    for (std::uint32_t i = 0; i < stated.size(); ++i)
        number_of[{surfaces.values[i], sets.find(i)}] = 0;
    std::uint32_t count = 0;
    for (auto& [region, number] : number_of) number = count++;
    for (std::uint32_t t = 0; t < surfaces.size(); ++t)
        for (std::uint32_t i = surfaces.offsets[t]; i < surfaces.offsets[t + 1]; ++i)
            if (const auto number = number_of[{surfaces.values[i], sets.find(i)}];
                stated[i] != number)
                found.push_back({Rule::R16_regions,
                                 {t},
                                 "triangle " + text(t) + " is in region " + text(number) +
                                     " of surface " + text(surfaces.values[i])});
}

} // namespace terrane::verifier
