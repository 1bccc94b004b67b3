// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/without_outside.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>

namespace terrane {
namespace {

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

/// Returns the faces of the tetrahedra, sorted.
std::vector<Triangle> faces_of(const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
    std::vector<Triangle> faces;
    faces.reserve(4 * tetrahedra.size());
    for (const auto& [a, b, c, d] : tetrahedra)
        for (const Triangle& f :
             {Triangle{a, b, c}, Triangle{a, b, d}, Triangle{a, c, d}, Triangle{b, c, d}})
            faces.push_back(sorted(f));
    std::sort(faces.begin(), faces.end());
    return faces;
}

void drop_tetrahedra(TetrahedralMesh& m) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < m.tetrahedra.size(); ++i) {
        if (m.block_of[i] == 0) continue;
        m.tetrahedra[kept] = m.tetrahedra[i];
        m.block_of[kept++] = m.block_of[i];
    }
    m.tetrahedra.resize(kept);
    m.block_of.resize(kept);
}

/// Removes the faces on the box, and those without a tetrahedron.
void drop_faces(TetrahedralMesh& m) {
    const auto left = faces_of(m.tetrahedra);
    std::vector<Triangle> faces;
    std::vector<std::uint32_t> face_triangle;
    IndexLists<std::uint32_t> surfaces_of;
    for (std::size_t f = 0; f < m.faces.size(); ++f) {
        if (m.face_triangle[f] == no_index ||
            !std::binary_search(left.begin(), left.end(), sorted(m.faces[f])))
            continue;
        faces.push_back(m.faces[f]);
        face_triangle.push_back(m.face_triangle[f]);
        surfaces_of.push_back(m.surfaces_of[f]);
    }
    const bool had_box = std::find(m.face_triangle.begin(), m.face_triangle.end(), no_index) !=
                         m.face_triangle.end();
    if (had_box) m.surfaces.pop_back();
    m.faces = std::move(faces);
    m.face_triangle = std::move(face_triangle);
    m.surfaces_of = std::move(surfaces_of);
}

void drop_vertices(TetrahedralMesh& m) {
    const VertexRenumbering numbers(used_vertices(m.vertices.size(), m.tetrahedra));
    numbers.compact(m.vertices);
    numbers.rename(m.tetrahedra);
    numbers.rename(m.faces);
}

} // namespace

TetrahedralMesh without_outside(TetrahedralMesh mesh) {
    drop_tetrahedra(mesh);
    drop_faces(mesh);
    drop_vertices(mesh);
    return mesh;
}

} // namespace terrane
