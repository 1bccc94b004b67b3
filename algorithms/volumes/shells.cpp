// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/shells.hpp>

#include <array>
#include <numeric>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/volumes/exact_volumes.hpp>
#include <terrane/algorithms/volumes/radial_sort.hpp>

namespace terrane {

using namespace volumes;

namespace {

/// Returns the shell of each side. Shells are numbered by their first sides.
std::vector<std::uint32_t> shell_of_sides(const TriangleComplex& sheets) {
    const auto count = static_cast<std::uint32_t>(2 * sheets.triangles.size());
    DisjointSets sides(count);
    join_round_edges(sheets, sides);
    std::vector<std::uint32_t> shell_of(count);
    std::uint32_t next = 0;
    for (std::uint32_t s = 0; s < count; ++s)
        shell_of[s] = sides.find(s) == s ? next++ : shell_of[sides.find(s)];
    return shell_of;
}

/// Tells which shells bound a volume from the outside: those around which the volume is positive,
/// as exact sums say.
std::vector<bool> bounding(const TriangleComplex& sheets,
                           const std::vector<std::uint32_t>& shell_of, std::size_t count) {
    std::vector<std::array<std::uint32_t, 2>> numbers; // from 1 on, as 0 would be the outside
    for (std::uint32_t t = 0; t < sheets.triangles.size(); ++t)
        numbers.push_back({shell_of[front_of(t)] + 1, shell_of[back_of(t)] + 1});
    const auto measures = exact_measures(sheets, numbers, count + 1, 10);
    std::vector<bool> positive;
    for (std::size_t s = 0; s < count; ++s)
        positive.push_back(measures[s + 1] != "0" && measures[s + 1][0] != '-');
    return positive;
}

} // namespace

Shells find_shells(const Mesh& mesh, const Volumes& volumes) {
    const PointStore points(mesh.vertices);
    std::vector<PointIndex> vertices(mesh.vertices.size());
    std::iota(vertices.begin(), vertices.end(), PointIndex{0});
    const EdgeSides edges = group_edges(mesh.triangles, mesh.vertices.size());
    const TriangleComplex sheets{points, vertices, mesh.triangles, edges, mesh.triangles, nullptr};

    const auto shell_of = shell_of_sides(sheets);
    std::vector<std::vector<std::uint32_t>> sides;
    Shells shells;
    for (std::uint32_t s = 0; s < shell_of.size(); ++s) {
        if (shell_of[s] == sides.size()) {
            sides.emplace_back();
            shells.volume.push_back(volumes.of_sides[s / 2][s % 2]);
        }
        sides[shell_of[s]].push_back(s);
    }
    for (const auto& list : sides) shells.sides.push_back(list);
    const auto outer = bounding(sheets, shell_of, sides.size());
    std::vector<std::uint32_t> bounding_shell(volumes.measures.size(), no_index);
    for (std::uint32_t s = 0; s < sides.size(); ++s)
        if (outer[s]) bounding_shell[shells.volume[s]] = s;
    for (std::uint32_t s = 0; s < sides.size(); ++s)
        shells.around.push_back(outer[s] ? no_index : bounding_shell[shells.volume[s]]);
    return shells;
}

} // namespace terrane
