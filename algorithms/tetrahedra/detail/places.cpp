// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/detail/places.hpp>

#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>

namespace terrane::tetrahedra::detail {

Places find_places(const Subject& subject) {
    const auto& [made, mesh, volumes, whole, findings] = subject;
    const auto nodes = static_cast<std::uint32_t>(made.vertices.size());
    std::vector<Point3> points = made.vertices;
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
    const auto in_use = used_vertices(nodes, made.tetrahedra);
    PointTable table(points.size());
    Places places;
    places.of_node.resize(nodes);
    for (std::uint32_t v = 0; v < nodes; ++v) {
        const std::uint32_t first = in_use[v] ? table.enter(points, v) : v;
        places.of_node[v] = made.twins.empty() ? v : first;
        if (first != v && made.twins.empty())
            findings.add(TetrahedraDefect::doubled_node, "nodes {} and {} are both at {}", first, v,
                         place_text(points[v]));
    }
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const std::uint32_t first = table.enter(points, nodes + v);
        places.of_vertex.push_back(first < nodes ? first : none);
    }
    return places;
}

void check_vertices(const Subject& subject, const Places& places) {
    const Mesh& mesh = subject.mesh;
    std::vector<bool> reported(mesh.vertices.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!subject.needs_faces(t)) continue;
        for (const std::uint32_t v : mesh.triangles[t]) {
            if (places.of_vertex[v] != none || reported[v]) continue;
            reported[v] = true;
            subject.findings.add(TetrahedraDefect::missing_vertex,
                                 "no node is at {}, vertex {} of the mesh",
                                 place_text(mesh.vertices[v]), v);
        }
    }
}

} // namespace terrane::tetrahedra::detail
