// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Meshes filled with tetrahedra, and nodes added to them on faces, edges and inside, rounded.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/rounded.hpp"
#include <terrane/algorithms/mesh/face_sides.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/kernel/predicates.hpp>

namespace test_support {

using namespace terrane;

/// A mesh, its volumes and its tetrahedra, with the nodes that divide() added.
struct Filled {
    Mesh mesh;
    Volumes volumes;
    TetrahedralMesh tetrahedra;
    std::vector<std::uint32_t> on_faces{}; ///< nodes inside triangles
    std::vector<std::uint32_t> on_edges{}; ///< nodes inside edges of triangles
    std::vector<std::uint32_t> inside{};   ///< nodes inside blocks
};

inline Filled fill(const Mesh& mesh, const TetrahedraOptions& options = {}) {
    auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    auto made = tetrahedralize(mesh, options, {});
    INFO((made ? std::string() : made.error().message()));
    REQUIRE(made);
    return {mesh, std::move(volumes).value(), std::move(made).value()};
}

inline Filled fill(const std::vector<Surface>& surfaces, const TetrahedraOptions& options = {}) {
    return fill(mesh_of(surfaces), options);
}

inline std::vector<TetrahedraViolation> violations_of(const Filled& f) {
    return check_tetrahedra(f.tetrahedra, f.mesh, f.volumes).violations;
}

/// All violations, a line each.
inline std::string text_of(const std::vector<TetrahedraViolation>& violations) {
    std::string text;
    for (const TetrahedraViolation& v : violations)
        text += std::string(name_of(v.defect)) + ": " + message(v) + "\n";
    return text;
}

/// Whether a cell has all these nodes.
template <class Cell, class Nodes>
bool has_all(const Cell& cell, const Nodes& nodes) {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t v) {
        return std::find(cell.begin(), cell.end(), v) != cell.end();
    });
}

inline bool is_positive(const TetrahedralMesh& m, const std::array<std::uint32_t, 4>& t) {
    const auto& v = m.vertices;
    return orient3d(v[t[0]], v[t[1]], v[t[2]], v[t[3]]) == Sign::Positive;
}

/// Adds a node that divides all cells which have `nodes` (an edge, a face or a tetrahedron): each
/// becomes as many as there are nodes, with the new one in place of one of them. Returns the node;
/// nothing, and the mesh as it was, if a tetrahedron would have no volume.
template <std::size_t N>
std::optional<std::uint32_t> add_node(TetrahedralMesh& mesh,
                                      const std::array<std::uint32_t, N>& nodes, const Point3& p) {
    TetrahedralMesh m = mesh;
    const auto node = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.push_back(p);
    const auto divided = [&](auto cell, std::uint32_t corner) {
        std::replace(cell.begin(), cell.end(), corner, node);
        return cell;
    };
    for (std::size_t t = 0, count = m.tetrahedra.size(); t < count; ++t) {
        const auto whole = m.tetrahedra[t];
        if (!has_all(whole, nodes)) continue;
        for (std::size_t k = 0; k < N; ++k) {
            const auto part = divided(whole, nodes[k]);
            if (!is_positive(m, part)) return std::nullopt;
            if (k == 0)
                m.tetrahedra[t] = part;
            else {
                m.tetrahedra.push_back(part);
                m.block_of.push_back(m.block_of[t]);
            }
        }
    }
    for (std::size_t f = 0, count = m.faces.size(); f < count; ++f) {
        const auto whole = m.faces[f];
        if (!has_all(whole, nodes)) continue;
        m.faces[f] = divided(whole, nodes[0]);
        for (std::size_t k = 1; k < N; ++k) {
            const auto surfaces = m.surfaces_of[f];
            const std::vector<std::uint32_t> copy(surfaces.begin(), surfaces.end());
            m.faces.push_back(divided(whole, nodes[k]));
            m.face_triangle.push_back(m.face_triangle[f]);
            m.surfaces_of.push_back(copy);
        }
    }
    mesh = std::move(m);
    return node;
}

/// The point of these corners with the weights 0.375, 0.34, ..., computed in doubles as TetGen
/// does: from the first corner along the edges to the others.
template <std::size_t N>
Point3 point_between(const TetrahedralMesh& m, const std::array<std::uint32_t, N>& nodes) {
    constexpr std::array weights{0.0, 0.375, 0.34, 0.15};
    const Point3& a = m.vertices[nodes[0]];
    Point3 p = a;
    for (std::size_t k = 1; k < N; ++k) {
        const Point3& b = m.vertices[nodes[k]];
        p.x += weights[k] * (b.x - a.x);
        p.y += weights[k] * (b.y - a.y);
        p.z += weights[k] * (b.z - a.z);
    }
    return p;
}

/// Whether a face is on a triangle between two volumes.
inline bool separates(const Filled& f, std::size_t face) {
    const std::uint32_t t = f.tetrahedra.face_triangle[face];
    return t != UINT32_MAX && !f.volumes.dangles(t);
}

/// The faces between volumes, the largest first.
inline std::vector<std::uint32_t> largest_faces(const Filled& f) {
    const TetrahedralMesh& m = f.tetrahedra;
    const auto area = [&](std::uint32_t face) {
        const auto& [i, j, k] = m.faces[face];
        const Point3 &a = m.vertices[i], &b = m.vertices[j], &c = m.vertices[k];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
        return std::hypot(uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx);
    };
    std::vector<std::pair<double, std::uint32_t>> by_area;
    for (std::uint32_t face = 0; face < m.faces.size(); ++face)
        if (separates(f, face)) by_area.emplace_back(-area(face), face);
    std::sort(by_area.begin(), by_area.end());
    std::vector<std::uint32_t> faces;
    for (const auto& [negative, face] : by_area) faces.push_back(face);
    return faces;
}

/// Whether a node is at a corner of the triangle of a face.
inline bool at_corner(const Filled& f, std::uint32_t face, std::uint32_t node) {
    const Triangle& corners = f.mesh.triangles[f.tetrahedra.face_triangle[face]];
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
        return f.mesh.vertices[v] == f.tetrahedra.vertices[node];
    });
}

/// Adds up to `count` nodes each on edges and inside of the largest triangles, and in tetrahedra.
inline void divide(Filled& f, std::size_t count) {
    TetrahedralMesh& m = f.tetrahedra;
    const auto large = largest_faces(f);
    for (std::size_t i = 0; i < large.size() && f.on_edges.size() < count; ++i) {
        const std::array edge{m.faces[large[i]][0], m.faces[large[i]][1]};
        if (!at_corner(f, large[i], edge[0]) || !at_corner(f, large[i], edge[1])) continue;
        if (const auto v = add_node(m, edge, point_between(m, edge))) f.on_edges.push_back(*v);
    }
    const auto next = largest_faces(f);
    for (std::size_t i = 0; i < next.size() && f.on_faces.size() < count; ++i) {
        const Triangle face = m.faces[next[i]];
        if (const auto v = add_node(m, face, point_between(m, face))) f.on_faces.push_back(*v);
    }
    for (std::uint32_t t = 0; t < m.tetrahedra.size() && f.inside.size() < count; ++t) {
        const auto corners = m.tetrahedra[t];
        if (m.block_of[t] != 0)
            if (const auto v = add_node(m, corners, point_between(m, corners)))
                f.inside.push_back(*v);
    }
}

} // namespace test_support
