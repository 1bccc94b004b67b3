// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/pylith.hpp>

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/msh_writer.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>

namespace terrane {

using namespace detail;

namespace {

/// The entities of a dimension and their cells.
template <class Cell>
struct Part {
    std::vector<MshEntity> entities;
    std::vector<Cell> cells;
};

/// The lines at which faults end, in an entity for each set of faults.
Part<Edge> fault_edges(const TetrahedralMesh& mesh, std::size_t first_tag) {
    const auto buried = buried_edges(mesh);
    std::map<Edge, std::vector<std::size_t>> faults_of;
    for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
        if (mesh.surfaces[s].role == Role::fault)
            for (const Edge& edge : buried[s]) faults_of[edge].push_back(first_tag + s);
    Part<Edge> part;
    std::map<std::vector<std::size_t>, std::vector<std::size_t>> cells_of;
    for (const auto& [edge, faults] : faults_of) {
        cells_of[faults].push_back(part.cells.size());
        part.cells.push_back(edge);
    }
    for (auto& [faults, cells] : cells_of)
        part.entities.push_back({1, part.entities.size() + 1, faults, std::move(cells), 1});
    return part;
}

std::vector<MshEntity> faces_by_surfaces(const TetrahedralMesh& mesh, std::size_t first_tag) {
    std::vector<MshEntity> entities;
    for (auto& group : surface_groups(mesh.surfaces_of, mesh.surfaces.size())) {
        std::vector<std::size_t> physical;
        for (const auto s : group.surfaces) physical.push_back(first_tag + s);
        entities.push_back({2, group.tag, std::move(physical), std::move(group.cells), 1});
    }
    return entities;
}

std::vector<MshEntity> materials(const NamedParts& parts) {
    std::vector<MshEntity> entities;
    for (const auto& block : parts.blocks)
        entities.push_back({3,
                            block.number,
                            {block.number},
                            {block.tetrahedra.begin(), block.tetrahedra.end()},
                            1});
    return entities;
}

std::vector<MshName> label_list(const NamedParts& parts, const Part<Edge>& edges,
                                std::size_t surfaces, std::size_t lines) {
    std::vector<MshName> names;
    std::map<std::size_t, std::string> name_of;
    for (const auto& entity : edges.entities)
        for (const auto tag : entity.physical)
            name_of[tag] = parts.surfaces[tag - lines] + "_edges";
    for (const auto& [tag, name] : name_of) names.push_back({1, tag, name});
    for (std::size_t s = 0; s < parts.surfaces.size(); ++s)
        names.push_back({2, surfaces + s, parts.surfaces[s]});
    for (const auto& block : parts.blocks)
        names.push_back({3, block.number, fmt::format("material-id:{}", block.number)});
    return names;
}

} // namespace

Result<std::string> to_pylith(const TetrahedralMesh& mesh) {
    if (!mesh.twins.empty())
        return Error{ErrorCode::unsupported,
                     "PyLith splits nodes itself: make this file without split surfaces", ""};
    const auto parts = named_parts(mesh, {});
    auto volumes = materials(parts);
    std::size_t blocks = mesh.block_count;
    for (const auto& block : parts.blocks) blocks = std::max(blocks, block.number);
    const auto edges = fault_edges(mesh, blocks + mesh.surfaces.size() + 1);
    auto surfaces = faces_by_surfaces(mesh, blocks + 1);
    auto next = edges.cells.size() + 1;
    for (auto& entity : surfaces) entity.first_element = next;
    next += mesh.faces.size();
    for (auto& entity : volumes) entity.first_element = next;
    const auto count = next + mesh.tetrahedra.size() - 1;
    MshWriter out(mesh.vertices);
    out.names(label_list(parts, edges, blocks + 1, blocks + mesh.surfaces.size() + 1));
    out.text(fmt::format("$Entities\n0 {} {} {}", edges.entities.size(), surfaces.size(),
                         volumes.size()));
    out.entities<Edge>(edges.entities, edges.cells);
    out.entities<Triangle>(surfaces, mesh.faces);
    out.entities<std::array<std::uint32_t, 4>>(volumes, mesh.tetrahedra);
    out.text("$EndEntities");
    if (!volumes.empty()) out.nodes(volumes[0]);
    out.text(fmt::format("$Elements\n{} {} 1 {}",
                         edges.entities.size() + surfaces.size() + volumes.size(), count, count));
    out.elements<Edge>(edges.entities, edges.cells, msh_line);
    out.elements<Triangle>(surfaces, mesh.faces, msh_triangle);
    out.elements<std::array<std::uint32_t, 4>>(volumes, mesh.tetrahedra, msh_tetrahedron);
    out.text("$EndElements");
    return out.take();
}

} // namespace terrane
