// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/prism_text.hpp>

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/vtk_writer.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {
namespace {

constexpr std::uint8_t vtk_wedge = 13, vtk_pyramid = 14;

std::uint8_t vtk_type_of(const PrismCell& cell) {
    return cell.size == 6 ? vtk_wedge : cell.size == 5 ? vtk_pyramid : detail::vtk_tetrahedron;
}

int gmsh_type_of(const PrismCell& cell) {
    constexpr int tetrahedron = 4, prism = 6, pyramid = 7;
    return cell.size == 6 ? prism : cell.size == 5 ? pyramid : tetrahedron;
}

} // namespace

std::string to_vtu(const PrismMesh& mesh) {
    std::vector<std::int64_t> nodes, offsets;
    std::vector<std::uint8_t> types;
    std::vector<std::int32_t> layers, triangles;
    for (const PrismCell& cell : mesh.cells) {
        auto order = cell.nodes;
        if (cell.size == 6) { // the first triangle of a wedge of VTK looks outward
            std::swap(order[1], order[2]);
            std::swap(order[4], order[5]);
        }
        nodes.insert(nodes.end(), order.begin(), order.begin() + cell.size);
        offsets.push_back(static_cast<std::int64_t>(nodes.size()));
        types.push_back(vtk_type_of(cell));
        layers.push_back(static_cast<std::int32_t>(cell.layer) + 1);
        triangles.push_back(static_cast<std::int32_t>(cell.triangle));
    }
    detail::VtkWriter out(true);
    out.begin_file("UnstructuredGrid");
    out.begin_piece(mesh.vertices.size(), mesh.cells.size());
    out.points(mesh.vertices);
    out.cells(nodes, offsets, types);
    out.text("<CellData Scalars=\"layer\">");
    out.array("layer", layers);
    out.array("triangle", triangles);
    out.text("</CellData>");
    return out.end_file("UnstructuredGrid");
}

std::string to_msh22(const PrismMesh& mesh) {
    std::uint32_t layers = 0;
    for (const PrismCell& cell : mesh.cells) layers = std::max(layers, cell.layer + 1);
    std::string out =
        fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", layers);
    for (std::uint32_t n = 1; n <= layers; ++n) out += fmt::format("3 {} \"layer {}\"\n", n, n);
    out += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Point3& p = mesh.vertices[v];
        out += fmt::format("{}", v + 1);
        for (const double x : {p.x, p.y, p.z}) {
            out += ' ';
            detail::append_number(out, x);
        }
        out += '\n';
    }
    out += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.cells.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const PrismCell& cell = mesh.cells[c];
        out +=
            fmt::format("{} {} 2 {} {}", c + 1, gmsh_type_of(cell), cell.layer + 1, cell.layer + 1);
        for (std::size_t k = 0; k < cell.size; ++k) out += fmt::format(" {}", cell.nodes[k] + 1);
        out += '\n';
    }
    return out + "$EndElements\n";
}

} // namespace terrane
