// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/structure.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>

namespace terrane {
namespace {

/// Adds triangles, oriented so that in_front(t) becomes the front side. Vertices keep their numbers.
template <class InFront>
void add_to(MeshPart& part, const Mesh& mesh, std::span<const std::uint32_t> triangles,
            const InFront& in_front) {
    Mesh& out = part.mesh;
    for (const std::uint32_t t : triangles) {
        Triangle corners = mesh.triangles[t];
        if (!in_front(t)) std::swap(corners[1], corners[2]);
        out.triangles.push_back(corners);
        out.surfaces_of.push_back(mesh.surfaces_of[t]);
        if (mesh.regions_of.size() != 0) out.regions_of.push_back(mesh.regions_of[t]);
        if (mesh.parents_of.size() != 0) out.parents_of.push_back(mesh.parents_of[t]);
    }
    part.triangles.insert(part.triangles.end(), triangles.begin(), triangles.end());
}

void add_block(MeshPart& part, const Mesh& mesh, const Volumes& volumes, const Structure& structure,
               std::uint32_t block) {
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t i : structure.blocks[block].interfaces) {
        const auto& more = structure.interfaces[i].triangles;
        triangles.insert(triangles.end(), more.begin(), more.end());
    }
    std::sort(triangles.begin(), triangles.end());
    add_to(part, mesh, triangles, [&](std::uint32_t t) { return volumes.of_sides[t][1] == block; });
}

void add_interface(MeshPart& part, const Mesh& mesh, const Volumes& volumes,
                   const ModelInterface& interface) {
    add_to(part, mesh, interface.triangles,
           [&](std::uint32_t t) { return volumes.of_sides[t][0] == interface.volumes[1]; });
}

/// Names the surfaces of its triangles alone.
void name_own(Mesh& part, const std::vector<SurfaceInfo>& surfaces) {
    std::vector<std::uint32_t> own = part.surfaces_of.values;
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (std::uint32_t& s : part.surfaces_of.values)
        s = static_cast<std::uint32_t>(std::lower_bound(own.begin(), own.end(), s) - own.begin());
    for (const std::uint32_t s : own) part.surfaces.push_back(surfaces[s]);
}

/// Gives a part its vertices and surfaces.
MeshPart finished(MeshPart part, const Mesh& mesh, PartSurfaces surfaces) {
    part.mesh.vertices = Submesh(mesh.vertices).cut(part.mesh.triangles);
    if (surfaces == PartSurfaces::all)
        part.mesh.surfaces = mesh.surfaces;
    else
        name_own(part.mesh, mesh.surfaces);
    return part;
}

} // namespace

MeshPart block_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                    BlockId block, PartSurfaces surfaces) {
    const StandardArithmetic guard;
    MeshPart part;
    add_block(part, mesh, volumes, structure, block);
    return finished(std::move(part), mesh, surfaces);
}

MeshPart interface_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                        InterfaceId interface, PartSurfaces surfaces) {
    const StandardArithmetic guard;
    MeshPart part;
    add_interface(part, mesh, volumes, structure.interfaces[interface]);
    return finished(std::move(part), mesh, surfaces);
}

MeshParts block_parts(const Mesh& mesh, const Volumes& volumes, const Structure& structure) {
    const StandardArithmetic guard;
    MeshParts parts;
    for (std::uint32_t b = 1; b < structure.blocks.size(); ++b) {
        add_block(parts.all, mesh, volumes, structure, b);
        parts.part_of.resize(parts.all.triangles.size(), b);
    }
    parts.all = finished(std::move(parts.all), mesh, PartSurfaces::all);
    return parts;
}

MeshParts interface_parts(const Mesh& mesh, const Volumes& volumes, const Structure& structure) {
    const StandardArithmetic guard;
    MeshParts parts;
    for (std::uint32_t i = 0; i < structure.interfaces.size(); ++i) {
        add_interface(parts.all, mesh, volumes, structure.interfaces[i]);
        parts.part_of.resize(parts.all.triangles.size(), i);
    }
    parts.all = finished(std::move(parts.all), mesh, PartSurfaces::all);
    return parts;
}

} // namespace terrane
