// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/opengeosys.hpp>

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>
#include <terrane/io/meshes/detail/vtk_writer.hpp>

namespace terrane {

using namespace detail;

namespace {

std::string bulk_file(const TetrahedralMesh& mesh, const EdgeNodes* nodes, const NamedParts& parts,
                      bool compress) {
    VtkWriter out(compress);
    out.begin_file("UnstructuredGrid");
    std::string list = "MaterialIDs:\n";
    for (const auto& block : parts.blocks) list += fmt::format("{} {}\n", block.block, block.name);
    out.comment(list);
    const auto& vertices = nodes ? nodes->vertices : mesh.vertices;
    const auto count = mesh.tetrahedra.size();
    out.begin_piece(vertices.size(), count);
    out.text("<CellData Scalars=\"MaterialIDs\">");
    out.array("MaterialIDs", std::vector<std::int32_t>(mesh.block_of.begin(), mesh.block_of.end()));
    out.text("</CellData>");
    out.points(vertices);
    std::vector<std::int64_t> corners, offsets;
    append_nodes(corners, mesh.tetrahedra, nodes ? &nodes->of_tetrahedra : nullptr);
    append_offsets(offsets, count, nodes ? 10 : 4);
    out.cells(corners, offsets,
              std::vector<std::uint8_t>(count, nodes ? vtk_tetrahedron_of_10 : vtk_tetrahedron));
    return out.end_file("UnstructuredGrid");
}

std::string side_file(const TetrahedralMesh& mesh, const EdgeNodes* nodes, const SideSet& set,
                      bool compress) {
    std::vector<std::vector<std::uint32_t>> faces;
    std::vector<std::uint32_t> used;
    std::vector<std::uint64_t> elements;
    for (const auto& side : set.sides) {
        faces.push_back(outward_nodes(mesh, nodes, side));
        used.insert(used.end(), faces.back().begin(), faces.back().end());
        elements.push_back(side.tetrahedron);
    }
    sort_unique(used);
    const auto& vertices = nodes ? nodes->vertices : mesh.vertices;
    std::vector<Point3> points;
    for (const auto v : used) points.push_back(vertices[v]);
    std::vector<std::int64_t> corners, offsets;
    for (const auto& face : faces)
        for (const auto v : face)
            corners.push_back(std::lower_bound(used.begin(), used.end(), v) - used.begin());
    append_offsets(offsets, faces.size(), nodes ? 6 : 3);
    VtkWriter out(compress);
    out.begin_file("UnstructuredGrid");
    out.begin_piece(points.size(), faces.size());
    out.text("<PointData>");
    out.array("bulk_node_ids", std::vector<std::uint64_t>(used.begin(), used.end()));
    out.text("</PointData>\n<CellData>");
    out.array("bulk_element_ids", elements);
    out.text("</CellData>");
    out.points(points);
    out.cells(corners, offsets,
              std::vector<std::uint8_t>(faces.size(), nodes ? vtk_triangle_of_6 : vtk_triangle));
    return out.end_file("UnstructuredGrid");
}

} // namespace

SeveralFiles to_opengeosys(const TetrahedralMesh& mesh, const VtkFiles& files,
                           std::span<const std::string> block_names, const EdgeNodes* nodes) {
    const auto parts = named_parts(mesh, block_names);
    SeveralFiles all{{"", bulk_file(mesh, nodes, parts, files.compress)}};
    for (const SideSet& set : parts.side_sets)
        all.push_back({fmt::format("{}_{}.vtu", files.stem, set.name),
                       side_file(mesh, nodes, set, files.compress)});
    return all;
}

} // namespace terrane
