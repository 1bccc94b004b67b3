// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/medit.hpp>

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Appends cells with their vertices, followed by their reference.
template <class Cell, class Reference>
void append_cells(std::string& out, std::string_view keyword, const std::vector<Cell>& cells,
                  const std::vector<Reference>& references) {
    out += fmt::format("\n{}\n{}\n", keyword, cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (const auto v : cells[i]) {
            append_number(out, std::uint64_t(v) + 1);
            out += ' ';
        }
        append_number(out, std::uint64_t(references[i]));
        out += '\n';
    }
}

std::string start(const std::vector<SurfaceInfo>& surfaces, const std::vector<SurfaceGroup>& groups,
                  const std::vector<Point3>& vertices) {
    // In version 2 coordinates are doubles.
    std::string out = "MeshVersionFormatted 2\n# references of triangles\n";
    out += tag_comments(groups, surfaces);
    out += fmt::format("\nDimension 3\n\nVertices\n{}\n", vertices.size());
    for (const Point3& p : vertices) {
        append_point(out, p);
        out += " 0\n";
    }
    return out;
}

/// Returns comments with the pairs of vertices in front of and behind each cut; MEDIT has no
/// keyword for them.
std::string pair_comments(const TetrahedralMesh& mesh) {
    std::string out;
    const auto pairs = node_pairs(mesh);
    const auto names = quotable_names(mesh.surfaces);
    for (std::size_t s = 0; s < pairs.size(); ++s) {
        if (pairs[s].empty()) continue;
        out += fmt::format("\n# vertices in front and back of {}\n", names[s]);
        for (const auto& [front, back] : pairs[s])
            out += fmt::format("# {} {}\n", front + 1, back + 1);
    }
    return out;
}

} // namespace

std::string to_medit(const Mesh& mesh) {
    const auto groups = surface_groups(mesh.surfaces_of, mesh.surfaces.size());
    auto out = start(mesh.surfaces, groups, mesh.vertices);
    append_cells(out, "Triangles", mesh.triangles, group_tags(groups, mesh.triangles.size()));
    return out + "\nEnd\n";
}

std::string to_medit(const TetrahedralMesh& mesh) {
    const auto groups = surface_groups(mesh.surfaces_of, mesh.surfaces.size(), cut_sides(mesh));
    auto out = start(mesh.surfaces, groups, mesh.vertices);
    append_cells(out, "Triangles", mesh.faces, group_tags(groups, mesh.faces.size()));
    append_cells(out, "Tetrahedra", mesh.tetrahedra, mesh.block_of);
    return out + pair_comments(mesh) + "\nEnd\n";
}

} // namespace terrane
