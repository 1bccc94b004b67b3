// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/inner_tetrahedra.hpp>

#include <algorithm>

#include <terrane/algorithms/face_sides.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

void keep_blocks(const TetrahedralMesh& mesh, TetrahedralMesh& out) {
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
        if (mesh.region_of[t] == 0) continue;
        out.tetrahedra.push_back(mesh.tetrahedra[t]);
        out.region_of.push_back(mesh.region_of[t]);
    }
}

void keep_faces(const TetrahedralMesh& mesh, TetrahedralMesh& out) {
    const auto sides = sides_of_faces(mesh);
    const auto inside = [&](const TetrahedronSide& side) {
        return side.exists() && mesh.region_of[side.tetrahedron] != 0;
    };
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (!inside(sides[f].front) && !inside(sides[f].back)) continue;
        out.faces.push_back(mesh.faces[f]);
        out.face_triangle.push_back(mesh.face_triangle[f]);
        out.surfaces_of.push_back(mesh.surfaces_of[f]);
    }
}

void keep_used_vertices(const TetrahedralMesh& mesh, TetrahedralMesh& out) {
    std::vector<std::uint32_t> number(mesh.vertices.size(), none);
    for (const auto& corners : out.tetrahedra)
        for (const std::uint32_t v : corners) number[v] = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == none) continue;
        number[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[v]);
    }
    for (auto& corners : out.tetrahedra)
        for (std::uint32_t& v : corners) v = number[v];
    for (auto& corners : out.faces)
        for (std::uint32_t& v : corners) v = number[v];
}

} // namespace

TetrahedralMesh inner_tetrahedra(const TetrahedralMesh& mesh) {
    TetrahedralMesh out;
    out.surfaces = mesh.surfaces;
    if (!out.surfaces.empty()) out.surfaces.pop_back(); // the box
    out.region_count = mesh.region_count;
    keep_blocks(mesh, out);
    keep_faces(mesh, out);
    keep_used_vertices(mesh, out);
    return out;
}

} // namespace terrane
