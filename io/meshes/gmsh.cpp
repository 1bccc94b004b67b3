// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/gmsh.hpp>

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/meshes/detail/msh_writer.hpp>
#include <terrane/io/meshes/detail/second_order.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Makes an entity of each group of triangles, with the physical tags of its surfaces.
std::vector<MshEntity> surface_entities(std::vector<SurfaceGroup> groups, std::size_t surface_count,
                                        std::size_t first_element) {
    std::vector<MshEntity> entities;
    for (auto& group : groups) {
        std::vector<std::size_t> physical;
        for (const auto surface : group.surfaces)
            physical.push_back(side_tag(surface, group.side, surface_count));
        entities.push_back(
            {2, group.tag, std::move(physical), std::move(group.cells), first_element});
    }
    return entities;
}

std::vector<MshEntity> volume_entities(const std::vector<std::uint32_t>& block_of,
                                       std::size_t surface_count) {
    std::map<std::uint32_t, MshEntity> entity_of;
    for (std::size_t i = 0; i < block_of.size(); ++i) entity_of[block_of[i]].cells.push_back(i);
    std::vector<MshEntity> entities;
    for (auto& [block, entity] : entity_of) {
        entity.dimension = 3;
        entity.tag = block + 1;
        entity.physical = {block_tag(block, surface_count)};
        entities.push_back(std::move(entity));
    }
    return entities;
}

std::vector<MshLink> periodic_links(const std::vector<SurfaceGroup>& groups,
                                    const TetrahedralMesh& mesh, const EdgeNodes* nodes) {
    const auto tags = group_tags(groups, mesh.faces.size());
    std::map<std::pair<std::size_t, std::size_t>, std::vector<NodePair>> pairs_of;
    for (const auto& twins : mesh.twins) {
        const auto front = twins[0], back = twins[1];
        auto& pairs = pairs_of[{tags[front], tags[back]}];
        const auto add = [&](const std::vector<Triangle>& of_faces) {
            for (std::size_t k = 0; k < 3; ++k)
                if (of_faces[front][k] != of_faces[back][k])
                    pairs.push_back({of_faces[front][k], of_faces[back][k]});
        };
        add(mesh.faces);
        if (nodes) add(nodes->of_faces);
    }
    std::vector<MshLink> links;
    for (auto& [entities, pairs] : pairs_of) {
        sort_unique(pairs);
        links.push_back({entities.first, entities.second, std::move(pairs)});
    }
    return links;
}

std::vector<MshName> names_of(const std::vector<SurfaceInfo>& surfaces,
                              std::span<const SideName> sides, std::span<const MshEntity> volumes,
                              std::span<const std::string> block_names) {
    std::vector<MshName> names;
    for (auto& name : quotable_names(surfaces)) names.push_back({2, names.size() + 1, name});
    for (const auto& side : sides) names.push_back({2, side.tag, side.name});
    for (const auto& volume : volumes)
        names.push_back({3, volume.physical.front(), block_name(volume.tag - 1, block_names)});
    return names;
}

/// The cells of a mesh, of first or second order.
template <class Tetrahedron, class Face>
struct MshCells {
    const std::vector<Tetrahedron>& tetrahedra;
    const std::vector<Face>& faces;
    int type_of_tetrahedra = msh_tetrahedron;
    int type_of_faces = msh_triangle;
};

template <class Tetrahedron, class Face>
std::string msh_of(const TetrahedralMesh& mesh, std::span<const std::string> block_names,
                   const EdgeNodes* nodes, const MshCells<Tetrahedron, Face>& cells) {
    const auto volumes = volume_entities(mesh.block_of, mesh.surfaces.size());
    const auto groups = surface_groups(mesh.surfaces_of, mesh.surfaces.size(), cut_sides(mesh));
    const auto surfaces =
        surface_entities(groups, mesh.surfaces.size(), mesh.tetrahedra.size() + 1);
    MshWriter out(nodes ? nodes->vertices : mesh.vertices);
    out.names(names_of(mesh.surfaces, side_names(groups, mesh.surfaces), volumes, block_names));
    out.text(fmt::format("$Entities\n0 0 {} {}", surfaces.size(), volumes.size()));
    out.entities<Face>(surfaces, cells.faces);
    out.entities<Tetrahedron>(volumes, cells.tetrahedra);
    out.text("$EndEntities");
    if (!volumes.empty()) out.nodes(volumes[0]);
    const auto count = mesh.tetrahedra.size() + mesh.faces.size();
    out.text(fmt::format("$Elements\n{} {} 1 {}", volumes.size() + surfaces.size(), count, count));
    out.elements<Tetrahedron>(volumes, cells.tetrahedra, cells.type_of_tetrahedra);
    out.elements<Face>(surfaces, cells.faces, cells.type_of_faces);
    out.text("$EndElements");
    out.periodic(periodic_links(groups, mesh, nodes));
    return out.take();
}

} // namespace

std::string to_msh(const Mesh& mesh) {
    const auto surfaces = surface_entities(surface_groups(mesh.surfaces_of, mesh.surfaces.size()),
                                           mesh.surfaces.size(), 1);
    MshWriter out(mesh.vertices);
    out.names(names_of(mesh.surfaces, {}, {}, {}));
    out.text(fmt::format("$Entities\n0 0 {} 0", surfaces.size()));
    out.entities<Triangle>(surfaces, mesh.triangles);
    out.text("$EndEntities");
    if (!surfaces.empty()) out.nodes(surfaces[0]);
    const auto count = mesh.triangles.size();
    out.text(fmt::format("$Elements\n{} {} 1 {}", surfaces.size(), count, count));
    out.elements<Triangle>(surfaces, mesh.triangles, msh_triangle);
    out.text("$EndElements");
    return out.take();
}

std::string to_msh(const TetrahedralMesh& mesh, std::span<const std::string> block_names,
                   const EdgeNodes* nodes) {
    if (!nodes)
        return msh_of(
            mesh, block_names, nodes,
            MshCells<std::array<std::uint32_t, 4>, Triangle>{mesh.tetrahedra, mesh.faces});
    const auto tetrahedra = tetrahedra_of_10(mesh, *nodes, order_of_gmsh);
    const auto faces = triangles_of_6(mesh, *nodes);
    return msh_of(mesh, block_names, nodes,
                  MshCells<std::array<std::uint32_t, 10>, std::array<std::uint32_t, 6>>{
                      tetrahedra, faces, msh_tetrahedron_of_10, msh_triangle_of_6});
}

} // namespace terrane
