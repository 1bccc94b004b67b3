// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/structure_meshes.hpp>

#include <algorithm>
#include <utility>

namespace terrane {
namespace {

/// Extracts triangles, oriented so that in_front(t) becomes the front side.
template <class InFront>
MeshPart part_of(const Mesh& mesh, std::vector<std::uint32_t> triangles, const InFront& in_front) {
    MeshPart part;
    Mesh& out = part.mesh;
    out.surfaces = mesh.surfaces;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t t : triangles)
        used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::uint32_t v : used) out.vertices.push_back(mesh.vertices[v]);
    const auto name = [&](std::uint32_t v) {
        return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) -
                                          used.begin());
    };
    for (const std::uint32_t t : triangles) {
        Triangle corners = mesh.triangles[t];
        if (!in_front(t)) std::swap(corners[1], corners[2]);
        out.triangles.push_back({name(corners[0]), name(corners[1]), name(corners[2])});
        out.surfaces_of.push_back(mesh.surfaces_of[t]);
        if (mesh.regions_of.size() != 0) out.regions_of.push_back(mesh.regions_of[t]);
        if (mesh.parents_of.size() != 0) out.parents_of.push_back(mesh.parents_of[t]);
    }
    part.triangles = std::move(triangles);
    return part;
}

} // namespace

MeshPart block_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                    std::uint32_t block) {
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t i : structure.blocks[block].interfaces) {
        const auto& more = structure.interfaces[i].triangles;
        triangles.insert(triangles.end(), more.begin(), more.end());
    }
    std::sort(triangles.begin(), triangles.end());
    return part_of(mesh, std::move(triangles),
                   [&](std::uint32_t t) { return volumes.of_sides[t][1] == block; });
}

MeshPart interface_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                        std::uint32_t interface) {
    const ModelInterface& i = structure.interfaces[interface];
    return part_of(mesh, i.triangles,
                   [&](std::uint32_t t) { return volumes.of_sides[t][0] == i.volumes[1]; });
}

} // namespace terrane
