// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fill_yardstick.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

namespace fill_bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

} // namespace

std::optional<terrane::Surface> filled_by_cgal(const terrane::Surface& surface,
                                               const std::vector<std::uint32_t>& border,
                                               bool fair) {
    Mesh mesh;
    for (const auto& p : surface.vertices) mesh.add_vertex({p.x, p.y, p.z});
    for (const auto& t : surface.triangles)
        if (!mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]),
                           Mesh::Vertex_index(t[2]))
                 .is_valid())
            return std::nullopt;
    const auto old = mesh.number_of_faces();
    Mesh::Halfedge_index start;
    for (const auto h : mesh.halfedges())
        if (mesh.is_border(h) && mesh.target(h) == Mesh::Vertex_index(border[0])) start = h;
    if (!start.is_valid()) return std::nullopt;
    std::vector<Mesh::Face_index> faces;
    std::vector<Mesh::Vertex_index> vertices;
    if (fair) {
        const auto done = pmp::triangulate_refine_and_fair_hole(
            mesh, start, std::back_inserter(faces), std::back_inserter(vertices));
        if (!std::get<0>(done)) return std::nullopt;
    } else {
        pmp::triangulate_hole(mesh, start, std::back_inserter(faces));
    }
    if (mesh.number_of_faces() == old) return std::nullopt;
    terrane::Surface result{surface.name, surface.role, {}, {}};
    for (const auto v : mesh.vertices()) {
        const auto& p = mesh.point(v);
        result.vertices.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto f : mesh.faces()) { // the old faces have the lower numbers
        terrane::Triangle t{};
        unsigned i = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[i++] = v;
        result.triangles.push_back(t);
    }
    return result;
}

} // namespace fill_bench
