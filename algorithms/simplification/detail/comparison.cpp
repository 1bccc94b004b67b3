// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/comparison.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::simplification::detail {
namespace {

using Pair = std::array<std::uint32_t, 2>;

/// The volumes in front of a cell and behind it, before, as its only layer tells.
Pair sides_before(const Cell& cell, const Volumes& before) {
    const CellLayer& layer = cell.layers.front();
    Pair sides = before.of_sides[layer.origin];
    if (layer.is_turned) std::swap(sides[0], sides[1]);
    return sides;
}

/// Areas by volume after and volume before.
std::map<Pair, double> votes_of(const Volumes& before, const Traced& after) {
    std::map<Pair, double> votes;
    const auto& points = after.mesh.vertices;
    for (std::size_t t = 0; t < after.cells.size(); ++t) {
        if (after.cells[t].layers.size() != 1) continue;
        const auto& [a, b, c] = after.mesh.triangles[t];
        const double area = length(cross(minus(points[b], points[a]), minus(points[c], points[a])));
        const Pair old = sides_before(after.cells[t], before), now = after.volumes.of_sides[t];
        for (std::size_t side = 0; side < 2; ++side) votes[{now[side], old[side]}] += area;
    }
    return votes;
}

std::vector<ChangedContact> difference(const std::set<Pair>& before, const std::set<Pair>& after) {
    std::vector<ChangedContact> all;
    for (const Pair& p : before)
        if (!after.contains(p)) all.push_back({p, false});
    for (const Pair& p : after)
        if (!before.contains(p)) all.push_back({p, true});
    std::sort(all.begin(), all.end(), [](const ChangedContact& a, const ChangedContact& b) {
        return a.between < b.between;
    });
    return all;
}

Pair ascending(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

std::set<Pair> surface_contacts(const Mesh& mesh) {
    std::set<Pair> pairs;
    const auto edges = group_edges(mesh.triangles, mesh.vertices.size());
    edges.for_each([&](std::uint32_t, std::uint32_t, std::span<const EdgeSides::Side> sides) {
        std::set<std::uint32_t> here;
        for (const auto& side : sides)
            here.insert(mesh.surfaces_of[side.triangle].begin(),
                        mesh.surfaces_of[side.triangle].end());
        for (auto s = here.begin(); s != here.end(); ++s)
            for (auto t = std::next(s); t != here.end(); ++t) pairs.insert({*s, *t});
    });
    return pairs;
}

} // namespace

std::vector<std::uint32_t> matched_blocks(const Volumes& before, const Traced& after) {
    std::vector<std::uint32_t> match(after.volumes.measures.size(), none);
    std::vector<double> most(match.size());
    for (const auto& [pair, area] : votes_of(before, after))
        if (area > most[pair[0]]) {
            most[pair[0]] = area;
            match[pair[0]] = pair[1];
        }
    match[0] = 0;
    return match;
}

std::vector<ChangedBlock> changed_blocks(const Volumes& before, const Traced& after,
                                         std::span<const std::uint32_t> block_before) {
    std::vector<std::size_t> parts(before.measures.size());
    for (const std::uint32_t b : block_before)
        if (b != none) ++parts[b];
    // A block that is gone became part of that which has most of its sides now.
    std::map<std::uint32_t, std::pair<double, std::uint32_t>> into;
    for (const auto& [pair, area] : votes_of(before, after)) {
        auto& best = into[pair[1]];
        if (area > best.first) best = {area, block_before[pair[0]]};
    }
    std::vector<ChangedBlock> changes;
    for (std::uint32_t b = 0; b < parts.size(); ++b) {
        if (parts[b] == 1) continue;
        const auto found = into.find(b);
        const bool is_part = parts[b] == 0 && found != into.end() && found->second.second != none;
        changes.push_back(
            {b, b == 0 ? 0 : before.measures[b], parts[b], is_part ? found->second.second : b});
    }
    return changes;
}

std::vector<ChangedContact> changed_block_contacts(const Volumes& before, const Traced& after,
                                                   std::span<const std::uint32_t> block_before) {
    std::set<Pair> old, now;
    for (const auto& [front, back] : before.of_sides)
        if (front != back) old.insert(ascending(front, back));
    for (const auto& sides : after.volumes.of_sides) {
        const std::uint32_t front = block_before[sides[0]], back = block_before[sides[1]];
        if (front != back && front != none && back != none) now.insert(ascending(front, back));
    }
    return difference(old, now);
}

std::vector<ChangedContact> changed_surface_contacts(const Mesh& before, const Mesh& after) {
    return difference(surface_contacts(before), surface_contacts(after));
}

} // namespace terrane::simplification::detail
