// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/gmsh22.hpp>

#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/meshes/detail/second_order.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

std::string physical_names(const std::vector<SurfaceInfo>& surfaces,
                           std::span<const SideName> sides, const std::set<std::uint32_t>& blocks,
                           std::span<const std::string> block_names) {
    auto text = fmt::format("$PhysicalNames\n{}\n", surfaces.size() + sides.size() + blocks.size());
    const auto names = quotable_names(surfaces);
    for (std::size_t s = 0; s < names.size(); ++s)
        text += fmt::format("2 {} \"{}\"\n", s + 1, names[s]);
    for (const auto& side : sides) text += fmt::format("2 {} \"{}\"\n", side.tag, side.name);
    for (const auto block : blocks)
        text += fmt::format("3 {} \"{}\"\n", block_tag(block, surfaces.size()),
                            block_name(block, block_names));
    return text + "$EndPhysicalNames\n";
}

std::string nodes(const std::vector<Point3>& vertices) {
    auto text = fmt::format("$Nodes\n{}\n", vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        append_number(text, std::uint64_t(v + 1));
        text += ' ';
        append_point(text, vertices[v]);
        text += '\n';
    }
    return text + "$EndNodes\n";
}

/// Collects the lines of $Elements, which are numbered from 1.
class Elements {
public:
    template <class Cell>
    void add(std::string_view type, std::uint64_t group, const Cell& corners) {
        append_number(text_, ++count_);
        text_.append(type);
        for (int tag = 0; tag < 2; ++tag) { // physical, then elementary
            text_ += ' ';
            append_number(text_, group);
        }
        for (const auto v : corners) {
            text_ += ' ';
            append_number(text_, std::uint64_t(v) + 1);
        }
        text_ += '\n';
    }

    /// `type` is that of elements, and how many tags they have.
    template <class Face>
    void add_faces(std::string_view type, const std::vector<Face>& faces,
                   const IndexLists<std::uint32_t>& surfaces_of, std::size_t surface_count,
                   std::span<const CutSide> sides = {}) {
        for (std::size_t t = 0; t < faces.size(); ++t)
            for (const auto s : surfaces_of[t]) {
                const CutSide side = sides.empty() ? CutSide::none : sides[t];
                add(type, side_tag(s, side, surface_count), faces[t]);
            }
    }

    template <class Tetrahedron>
    void add_tetrahedra(std::string_view type, const std::vector<Tetrahedron>& tetrahedra,
                        const TetrahedralMesh& mesh) {
        for (std::size_t t = 0; t < tetrahedra.size(); ++t)
            add(type, block_tag(mesh.block_of[t], mesh.surfaces.size()), tetrahedra[t]);
    }

    [[nodiscard]] std::string section() const {
        return fmt::format("$Elements\n{}\n", count_) + text_ + "$EndElements\n";
    }

private:
    std::string text_;
    std::uint64_t count_ = 0;
};

constexpr std::string_view format_section = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

/// Returns the section $Periodic: for each split surface, the nodes behind it with the nodes at the
/// same points in front of it.
std::string periodic(const TetrahedralMesh& mesh, const EdgeNodes* edge_nodes) {
    const auto pairs = edge_nodes ? node_pairs(mesh, *edge_nodes) : node_pairs(mesh);
    std::size_t links = 0;
    std::string text;
    for (std::size_t s = 0; s < pairs.size(); ++s) {
        if (pairs[s].empty()) continue;
        ++links;
        text += fmt::format("2 {} {}\n{}\n", side_tag(s, CutSide::back, pairs.size()),
                            side_tag(s, CutSide::front, pairs.size()), pairs[s].size());
        for (const auto& [front, back] : pairs[s])
            text += fmt::format("{} {}\n", back + 1, front + 1);
    }
    return links == 0 ? "" : fmt::format("$Periodic\n{}\n{}$EndPeriodic\n", links, text);
}

} // namespace

std::string to_msh22(const Mesh& mesh) {
    Elements elements;
    elements.add_faces(" 2 2", mesh.triangles, mesh.surfaces_of, mesh.surfaces.size());
    return std::string(format_section) + physical_names(mesh.surfaces, {}, {}, {}) +
           nodes(mesh.vertices) + elements.section();
}

std::string to_msh22(const TetrahedralMesh& mesh, std::span<const std::string> block_names,
                     const EdgeNodes* edge_nodes) {
    Elements elements;
    const auto sides = cut_sides(mesh);
    const auto count = mesh.surfaces.size();
    if (edge_nodes) {
        elements.add_tetrahedra(" 11 2", tetrahedra_of_10(mesh, *edge_nodes, order_of_gmsh), mesh);
        elements.add_faces(" 9 2", triangles_of_6(mesh, *edge_nodes), mesh.surfaces_of, count,
                           sides);
    } else {
        elements.add_tetrahedra(" 4 2", mesh.tetrahedra, mesh);
        elements.add_faces(" 2 2", mesh.faces, mesh.surfaces_of, count, sides);
    }
    const std::set<std::uint32_t> blocks(mesh.block_of.begin(), mesh.block_of.end());
    const auto groups = surface_groups(mesh.surfaces_of, count, sides);
    return std::string(format_section) +
           physical_names(mesh.surfaces, side_names(groups, mesh.surfaces), blocks, block_names) +
           nodes(edge_nodes ? edge_nodes->vertices : mesh.vertices) + elements.section() +
           periodic(mesh, edge_nodes);
}

} // namespace terrane
