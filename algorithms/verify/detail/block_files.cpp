// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/block_files.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>

namespace terrane::verifier {

namespace {

using InterfaceKey = std::pair<BlockSides, Numbers>; ///< blocks, the lower first, and surfaces

InterfaceKey interface_key(const WrittenMesh& mesh, const std::vector<BlockSides>& sides,
                           std::uint32_t t) {
    const auto [front, back] = sides[t];
    const auto surfaces = mesh.surfaces_of[t];
    return {{std::min(front, back), std::max(front, back)}, {surfaces.begin(), surfaces.end()}};
}

/// Returns the ranks of the vertices of triangles, ascending.
Numbers ranks_in(const WrittenMesh& mesh, const Numbers& rank, const Numbers& triangles) {
    Numbers all;
    for (const std::uint32_t t : triangles)
        for (const std::uint32_t v : mesh.triangles[t]) all.push_back(rank[v]);
    make_set(all);
    return all;
}

/// Groups the triangles by patches, in the order of their first triangles.
std::vector<Numbers> connected(const WrittenMesh& mesh, const Numbers& interface_of) {
    JoinedSets sets(mesh.triangles.size());
    for (const auto& [edge, around] : triangles_at_edges(mesh.triangles))
        if (around.size() == 2 && interface_of[around[0]] == interface_of[around[1]])
            sets.join(around[0], around[1]);
    std::map<std::uint32_t, Numbers> groups;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) groups[sets.find(t)].push_back(t);
    std::vector<Numbers> all;
    for (auto& [first, triangles] : groups) all.push_back(std::move(triangles));
    return all;
}

} // namespace

Numbers ranks_of(const std::vector<Point3>& vertices) {
    Numbers order(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return vertices[a] < vertices[b]; });
    Numbers rank(order.size());
    for (std::uint32_t r = 0; r < order.size(); ++r) rank[order[r]] = r;
    return rank;
}

BlockParts find_parts(const WrittenMesh& mesh, const std::vector<BlockSides>& sides) {
    const Numbers rank = ranks_of(mesh.vertices);
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    std::map<InterfaceKey, Numbers> groups;
    for (std::uint32_t t = 0; t < count; ++t) groups[interface_key(mesh, sides, t)].push_back(t);
    std::vector<std::tuple<BlockSides, Numbers, std::uint32_t, const Numbers*>> order;
    for (const auto& [key, triangles] : groups)
        order.emplace_back(key.first, ranks_in(mesh, rank, triangles), triangles[0], &triangles);
    std::sort(order.begin(), order.end());
    BlockParts parts;
    parts.interface_of.resize(count);
    parts.patch_of.resize(count);
    for (std::uint32_t t = 0; t < count; ++t) {
        const auto [front, back] = sides[t];
        if (front == back) continue;
        parts.around[front].push_back(t);
        parts.around[back].push_back(t);
    }
    for (const auto& [blocks, ranks, first, triangles] : order) {
        for (const std::uint32_t t : *triangles)
            parts.interface_of[t] = static_cast<std::uint32_t>(parts.interfaces.size());
        const auto surfaces = mesh.surfaces_of[first];
        parts.interfaces.push_back({blocks, {surfaces.begin(), surfaces.end()}, *triangles, {}});
    }
    std::vector<std::tuple<Numbers, std::uint32_t, Numbers>> patches;
    for (Numbers& triangles : connected(mesh, parts.interface_of)) {
        Numbers ranks = ranks_in(mesh, rank, triangles);
        patches.emplace_back(std::move(ranks), triangles[0], std::move(triangles));
    }
    std::sort(patches.begin(), patches.end());
    for (auto& [ranks, first, triangles] : patches) {
        const auto number = static_cast<std::uint32_t>(parts.patches.size());
        for (const std::uint32_t t : triangles) parts.patch_of[t] = number;
        parts.interfaces[parts.interface_of[first]].patches.push_back(number);
        parts.patches.push_back({parts.interface_of[first], std::move(triangles)});
    }
    return parts;
}

void take_block(const std::vector<BlockSides>& sides, const BlockParts& parts, std::uint32_t block,
                std::vector<Taken>& taken) {
    for (const std::uint32_t t : parts.around.at(block)) taken.push_back({t, sides[t][0] == block});
}

void take_interface(const std::vector<BlockSides>& sides, const Interface& interface,
                    std::vector<Taken>& taken) {
    for (const std::uint32_t t : interface.triangles)
        taken.push_back({t, sides[t][0] < sides[t][1]});
}

PartMesh part_of(const WrittenMesh& mesh, const std::vector<Taken>& taken) {
    PartMesh part;
    Numbers used;
    for (const auto& [t, turned] : taken)
        used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    make_set(used);
    for (const std::uint32_t v : used) part.vertices.push_back(mesh.vertices[v]);
    const auto number = [&](std::uint32_t v) {
        return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) -
                                          used.begin());
    };
    for (const auto& [t, turned] : taken) {
        auto [a, b, c] = mesh.triangles[t];
        if (turned) std::swap(b, c);
        part.triangles.push_back({number(a), number(b), number(c)});
        part.surfaces_of.push_back(mesh.surfaces_of[t]);
        part.regions_of.push_back(mesh.regions_of[t]);
        part.parents_of.push_back(mesh.parents_of[t]);
        part.numbers.push_back(t);
    }
    return part;
}

} // namespace terrane::verifier
