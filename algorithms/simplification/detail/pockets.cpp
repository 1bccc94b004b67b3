// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/pockets.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::simplification::detail {
namespace {

double area_of(const Mesh& mesh, std::uint32_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto& p = mesh.vertices;
    return length(cross(minus(p[b], p[a]), minus(p[c], p[a]))) / 2;
}

/// The triangles around a block, by the neighbour and the surfaces.
struct Interfaces {
    using Key = std::pair<std::uint32_t, std::vector<std::uint32_t>>;
    std::map<Key, std::pair<double, std::vector<std::uint32_t>>> all; ///< area, triangles
};

bool is_boundary(const Mesh& mesh, const std::vector<std::uint32_t>& surfaces) {
    return std::any_of(surfaces.begin(), surfaces.end(),
                       [&](std::uint32_t s) { return mesh.surfaces[s].role == Role::boundary; });
}

/// Returns the triangles of the largest interface that may go; empty without such an interface.
std::vector<std::uint32_t> largest(const Mesh& mesh, const Interfaces& interfaces, bool may_open) {
    const std::pair<double, std::vector<std::uint32_t>>* best = nullptr;
    for (const auto& [key, face] : interfaces.all)
        if ((key.first != 0 || may_open) && !is_boundary(mesh, key.second) &&
            (!best || face.first > best->first))
            best = &face;
    return best ? best->second : std::vector<std::uint32_t>{};
}

/// Adds a layer that was on the other side of a block, so that the block is behind it where it was in
/// front, and the other way round. `side`: of the cell, on which the block is; `was`: of the layer.
void add_layer(Cell& cell, CellLayer layer, std::size_t side, std::size_t was) {
    const auto at = std::lower_bound(
        cell.layers.begin(), cell.layers.end(), layer.surface,
        [](const CellLayer& l, std::uint32_t surface) { return l.surface < surface; });
    if (at != cell.layers.end() && at->surface == layer.surface) return;
    layer.is_turned = side == was;
    cell.layers.insert(at, layer);
}

} // namespace

std::vector<double> thicknesses(const Mesh& mesh, const Volumes& volumes) {
    std::vector<double> area(volumes.measures.size()), thickness(area.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (!volumes.dangles(t))
            for (const std::uint32_t v : volumes.of_sides[t]) area[v] += area_of(mesh, t);
    for (std::size_t v = 1; v < area.size(); ++v)
        thickness[v] = area[v] > 0 ? 2 * volumes.measures[v] / area[v] : 0;
    return thickness;
}

std::size_t dissolve(const Mesh& mesh, const Volumes& volumes,
                     std::span<const std::uint32_t> blocks,
                     std::span<const std::uint32_t> block_before, std::vector<Cell>& cells) {
    std::map<std::uint32_t, Interfaces> wanted;
    for (const std::uint32_t b : blocks) wanted[b];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t side = 0; side < 2 && !volumes.dangles(t); ++side) {
            const auto found = wanted.find(volumes.of_sides[t][side]);
            if (found == wanted.end()) continue;
            const auto of = mesh.surfaces_of[t];
            auto& [area, triangles] =
                found->second.all[{volumes.of_sides[t][1 - side], {of.begin(), of.end()}}];
            area += area_of(mesh, t);
            triangles.push_back(t);
        }
    std::size_t count = 0;
    std::vector<bool> is_used(volumes.measures.size()); // blocks that changed, or whose sides did
    for (const auto& [block, interfaces] : wanted) {
        if (is_used[block]) continue;
        const auto gone = largest(mesh, interfaces, block_before[block] == 0);
        if (gone.empty()) continue;
        ++count;
        const Cell& first = cells[gone.front()];
        const std::size_t side = volumes.of_sides[gone.front()][0] == block ? 0 : 1;
        const std::vector<CellLayer> layers = first.layers;
        for (const auto& [key, face] : interfaces.all) {
            is_used[key.first] = key.first != 0;
            if (face.second == gone) continue;
            for (const std::uint32_t t : face.second)
                for (const CellLayer& layer : layers)
                    add_layer(cells[t], layer, volumes.of_sides[t][0] == block ? 0 : 1,
                              layer.is_turned ? 1 - side : side);
        }
        for (const std::uint32_t t : gone) cells[t].layers.clear();
    }
    return count;
}

} // namespace terrane::simplification::detail
