// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/structure_meshes.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>

namespace terrane {
namespace {

/// Extracts triangles, oriented so that in_front(t) becomes the front side.
template <class InFront>
MeshPart part_of(const Mesh& mesh, std::vector<std::uint32_t> triangles, const InFront& in_front) {
    MeshPart part;
    Mesh& out = part.mesh;
    out.surfaces = mesh.surfaces;
    for (const std::uint32_t t : triangles) {
        Triangle corners = mesh.triangles[t];
        if (!in_front(t)) std::swap(corners[1], corners[2]);
        out.triangles.push_back(corners);
        out.surfaces_of.push_back(mesh.surfaces_of[t]);
        if (mesh.regions_of.size() != 0) out.regions_of.push_back(mesh.regions_of[t]);
        if (mesh.parents_of.size() != 0) out.parents_of.push_back(mesh.parents_of[t]);
    }
    out.vertices = Submesh(mesh.vertices).cut(out.triangles);
    part.triangles = std::move(triangles);
    return part;
}

} // namespace

MeshPart block_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                    BlockId block) {
    const StandardArithmetic guard;
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
                        InterfaceId interface) {
    const StandardArithmetic guard;
    const ModelInterface& i = structure.interfaces[interface];
    return part_of(mesh, i.triangles,
                   [&](std::uint32_t t) { return volumes.of_sides[t][0] == i.volumes[1]; });
}

} // namespace terrane
