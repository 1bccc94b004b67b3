// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/gmsh.hpp>

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr int triangle_type = 2;
constexpr int tetrahedron_type = 4;

/// A discrete entity of Gmsh and its cells.
struct Entity {
    int dimension = 2;
    std::size_t tag = 0;
    std::vector<std::size_t> physical; ///< tags, ascending
    std::vector<std::size_t> cells;    ///< indices, ascending
    std::size_t first_element = 1;     ///< number of the element that is cell 0
};

/// Makes an entity of each group of triangles, with the physical tags of its surfaces.
std::vector<Entity> surface_entities(std::vector<SurfaceGroup> groups, std::size_t surface_count,
                                     std::size_t first_element) {
    std::vector<Entity> entities;
    for (auto& group : groups) {
        std::vector<std::size_t> physical;
        for (const auto surface : group.surfaces)
            physical.push_back(side_tag(surface, group.side, surface_count));
        entities.push_back(
            {2, group.tag, std::move(physical), std::move(group.cells), first_element});
    }
    return entities;
}

std::vector<Entity> volume_entities(const std::vector<std::uint32_t>& region_of,
                                    std::size_t surface_count) {
    std::map<std::uint32_t, Entity> entity_of;
    for (std::size_t i = 0; i < region_of.size(); ++i) entity_of[region_of[i]].cells.push_back(i);
    std::vector<Entity> entities;
    for (auto& [region, entity] : entity_of) {
        entity.dimension = 3;
        entity.tag = region + 1;
        entity.physical = {region_tag(region, surface_count)};
        entities.push_back(std::move(entity));
    }
    return entities;
}

/// The two entities on the sides of a cut, and their nodes.
struct PeriodicLink {
    std::size_t front = 0, back = 0; ///< tags of the entities
    std::vector<NodePair> pairs;     ///< {front, back}, only where they differ; sorted, unique
};

std::vector<PeriodicLink> periodic_links(const std::vector<SurfaceGroup>& groups,
                                         const TetrahedralMesh& mesh) {
    const auto tags = group_tags(groups, mesh.faces.size());
    std::map<std::pair<std::size_t, std::size_t>, std::vector<NodePair>> pairs_of;
    for (const auto& [front, back] : mesh.twins) {
        auto& pairs = pairs_of[{tags[front], tags[back]}];
        for (std::size_t k = 0; k < 3; ++k)
            if (mesh.faces[front][k] != mesh.faces[back][k])
                pairs.push_back({mesh.faces[front][k], mesh.faces[back][k]});
    }
    std::vector<PeriodicLink> links;
    for (auto& [entities, pairs] : pairs_of) {
        sort_unique(pairs);
        links.push_back({entities.first, entities.second, std::move(pairs)});
    }
    return links;
}

class MshWriter {
public:
    explicit MshWriter(const std::vector<Point3>& vertices) : vertices_(vertices) {
        out_ = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
        out_.reserve(vertices.size() * 96);
    }

    void names(const std::vector<SurfaceInfo>& surfaces, std::span<const SideName> sides,
               std::span<const Entity> volumes, std::span<const std::string> region_names) {
        out_ +=
            fmt::format("$PhysicalNames\n{}\n", surfaces.size() + sides.size() + volumes.size());
        const auto names = quotable_names(surfaces);
        for (std::size_t s = 0; s < names.size(); ++s)
            out_ += fmt::format("2 {} \"{}\"\n", s + 1, names[s]);
        for (const auto& side : sides) out_ += fmt::format("2 {} \"{}\"\n", side.tag, side.name);
        for (const auto& volume : volumes)
            out_ += fmt::format("3 {} \"{}\"\n", volume.physical.front(),
                                region_name(volume.tag - 1, region_names));
        out_ += "$EndPhysicalNames\n";
    }

    template <class Cell>
    void entities(std::span<const Entity> entities, const std::vector<Cell>& cells) {
        for (const auto& entity : entities) {
            append_number(out_, std::uint64_t(entity.tag));
            append_box(entity, cells);
            out_ += fmt::format(" {}", entity.physical.size());
            for (const auto tag : entity.physical) out_ += fmt::format(" {}", tag);
            out_ += " 0\n"; // no bounding entities are stated
        }
    }

    /// Writes all nodes in one block, which belongs to the given entity.
    void nodes(const Entity& entity) {
        const auto count = vertices_.size();
        out_ += fmt::format("$Nodes\n1 {} 1 {}\n{} {} 0 {}\n", count, count, entity.dimension,
                            entity.tag, count);
        for (std::size_t v = 0; v < count; ++v) {
            append_number(out_, std::uint64_t(v + 1));
            out_ += '\n';
        }
        for (const auto& vertex : vertices_) {
            append_point(out_, vertex);
            out_ += '\n';
        }
        out_ += "$EndNodes\n";
    }

    template <class Cell>
    void elements(std::span<const Entity> entities, const std::vector<Cell>& cells, int type) {
        for (const auto& entity : entities) {
            text(fmt::format("{} {} {} {}", entity.dimension, entity.tag, type,
                             entity.cells.size()));
            for (const auto cell : entity.cells) {
                append_number(out_, std::uint64_t(entity.first_element + cell));
                for (const auto vertex : cells[cell]) {
                    out_ += ' ';
                    append_number(out_, std::uint64_t(vertex) + 1);
                }
                out_ += '\n';
            }
        }
    }

    /// Writes, for each link, the pairs of nodes of its two entities that are at the same point.
    void periodic(std::span<const PeriodicLink> links) {
        if (links.empty()) return;
        text(fmt::format("$Periodic\n{}", links.size()));
        for (const auto& link : links) {
            text(fmt::format("2 {} {}\n0\n{}", link.back, link.front, link.pairs.size()));
            for (const auto& [front, back] : link.pairs)
                text(fmt::format("{} {}", back + 1, front + 1));
        }
        text("$EndPeriodic");
    }

    void text(std::string_view line) { out_.append(line).append("\n"); }
    std::string take() { return std::move(out_); }

private:
    template <class Cell>
    void append_box(const Entity& entity, const std::vector<Cell>& cells) {
        auto low = vertices_[cells[entity.cells[0]][0]];
        auto high = low;
        for (const auto cell : entity.cells)
            for (const auto vertex : cells[cell]) {
                const auto& p = vertices_[vertex];
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
        for (const auto& corner : {low, high}) {
            out_ += ' ';
            append_point(out_, corner);
        }
    }

    std::string out_;
    const std::vector<Point3>& vertices_;
};

} // namespace

std::string to_msh(const Mesh& mesh) {
    const auto surfaces = surface_entities(surface_groups(mesh.surfaces_of, mesh.surfaces.size()),
                                           mesh.surfaces.size(), 1);
    MshWriter out(mesh.vertices);
    out.names(mesh.surfaces, {}, {}, {});
    out.text(fmt::format("$Entities\n0 0 {} 0", surfaces.size()));
    out.entities<Triangle>(surfaces, mesh.triangles);
    out.text("$EndEntities");
    if (!surfaces.empty()) out.nodes(surfaces[0]);
    const auto count = mesh.triangles.size();
    out.text(fmt::format("$Elements\n{} {} 1 {}", surfaces.size(), count, count));
    out.elements<Triangle>(surfaces, mesh.triangles, triangle_type);
    out.text("$EndElements");
    return out.take();
}

std::string to_msh(const TetrahedralMesh& mesh, std::span<const std::string> region_names) {
    const auto volumes = volume_entities(mesh.region_of, mesh.surfaces.size());
    const auto groups = surface_groups(mesh.surfaces_of, mesh.surfaces.size(), cut_sides(mesh));
    const auto surfaces =
        surface_entities(groups, mesh.surfaces.size(), mesh.tetrahedra.size() + 1);
    MshWriter out(mesh.vertices);
    out.names(mesh.surfaces, side_names(groups, mesh.surfaces), volumes, region_names);
    out.text(fmt::format("$Entities\n0 0 {} {}", surfaces.size(), volumes.size()));
    out.entities<Triangle>(surfaces, mesh.faces);
    out.entities(std::span<const Entity>(volumes), mesh.tetrahedra);
    out.text("$EndEntities");
    if (!volumes.empty()) out.nodes(volumes[0]);
    const auto count = mesh.tetrahedra.size() + mesh.faces.size();
    out.text(fmt::format("$Elements\n{} {} 1 {}", volumes.size() + surfaces.size(), count, count));
    out.elements(std::span<const Entity>(volumes), mesh.tetrahedra, tetrahedron_type);
    out.elements<Triangle>(surfaces, mesh.faces, triangle_type);
    out.text("$EndElements");
    out.periodic(periodic_links(groups, mesh));
    return out.take();
}

} // namespace terrane
