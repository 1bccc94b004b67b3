// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/tetrahedra_damage.hpp"

#include <limits>

namespace test_support {
namespace {

using Defect = TetrahedraDefect;

Point3 sum(const Point3& p, const Point3& d, double times) {
    return {p.x + times * d.x, p.y + times * d.y, p.z + times * d.z};
}

double size_of(const Filled& f) {
    double size = 0;
    for (const Point3& p : f.mesh.vertices)
        size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return size;
}

/// The triangle that a node is on.
std::uint32_t triangle_at(const Filled& f, std::uint32_t node) {
    const auto& faces = f.tetrahedra.faces;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (has_all(faces[i], std::array{node})) return f.tetrahedra.face_triangle[i];
    FAIL("the node is on no face");
    return 0;
}

/// The normal of a triangle, of length 1.
Point3 normal(const Filled& f, std::uint32_t triangle) {
    const auto& [i, j, k] = f.mesh.triangles[triangle];
    const Point3 &a = f.mesh.vertices[i], &b = f.mesh.vertices[j], &c = f.mesh.vertices[k];
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const double wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
    const double x = uy * wz - uz * wy, y = uz * wx - ux * wz, z = ux * wy - uy * wx;
    const double length = std::hypot(x, y, z);
    return {x / length, y / length, z / length};
}

/// Moves a node along the normal of its triangle.
void lift(Filled& f, std::uint32_t node, double by) {
    Point3& p = f.tetrahedra.vertices[node];
    p = sum(p, normal(f, triangle_at(f, node)), by);
}

/// Moves a node of a triangle beyond a corner of the triangle, in its plane.
void move_beyond(Filled& f, std::uint32_t node, std::size_t corner) {
    const Triangle& corners = f.mesh.triangles[triangle_at(f, node)];
    Point3& p = f.tetrahedra.vertices[node];
    const Point3& to = f.mesh.vertices[corners[corner]];
    p = {p.x + 1.25 * (to.x - p.x), p.y + 1.25 * (to.y - p.y), p.z + 1.25 * (to.z - p.z)};
}

/// The node at the first corner of a triangle between volumes.
std::uint32_t corner_node(const Filled& f) {
    for (const std::uint32_t face : largest_faces(f))
        for (const std::uint32_t node : f.tetrahedra.faces[face])
            if (at_corner(f, face, node)) return node;
    FAIL("no corner");
    return 0;
}

/// Gives some tetrahedra a copy of a node.
template <class Which>
void copy_node(Filled& f, std::uint32_t node, const Which& which) {
    TetrahedralMesh& m = f.tetrahedra;
    const auto copy = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.push_back(Point3(m.vertices[node]));
    for (std::uint32_t t = 0; t < m.tetrahedra.size(); ++t)
        if (which(t)) std::replace(m.tetrahedra[t].begin(), m.tetrahedra[t].end(), node, copy);
}

/// Moves all nodes.
template <class Move>
void move_all(Filled& f, const Move& move) {
    for (Point3& p : f.tetrahedra.vertices) p = move(p);
}

constexpr double ulp = std::numeric_limits<double>::epsilon();

} // namespace

namespace {

/// Lists damage to nodes that divide triangles and edges.
std::vector<Damage> damage_to_nodes_on_triangles() {
    return {
        {"a node on a triangle 40 ulps off its plane", Defect::node_off_plane,
         [](Filled& f) { lift(f, f.on_faces.front(), 40 * ulp * size_of(f)); }},
        {"a node on a triangle 1e-12 of the size off its plane", Defect::node_off_plane,
         [](Filled& f) { lift(f, f.on_faces.front(), 1e-12 * 16 * size_of(f)); }},
        {"a node on a triangle 1e-6 off its plane", Defect::node_off_plane,
         [](Filled& f) { lift(f, f.on_faces.front(), 1e-6); }},
        {"a node on a triangle .15 off its plane", Defect::node_off_plane,
         [](Filled& f) { lift(f, f.on_faces.front(), .15); }},
        {"all nodes on triangles 1e-7 of the size off their planes", Defect::node_off_plane,
         [](Filled& f) {
             for (const std::uint32_t node : f.on_faces) lift(f, node, 1e-7 * size_of(f));
         }},
        {"a node on an edge 40 ulps off it", Defect::node_off_edge,
         [](Filled& f) { lift(f, f.on_edges.front(), 40 * ulp * size_of(f)); }},
        {"a node on an edge 1e-6 off it", Defect::node_off_edge,
         [](Filled& f) { lift(f, f.on_edges.front(), 1e-6); }},
        {"a node moved within its plane, so that faces overlap", Defect::folded_faces,
         [](Filled& f) { move_beyond(f, f.on_faces.front(), 0); }},
        {"a node on an edge moved beyond the end of the edge", Defect::folded_faces,
         [](Filled& f) {
             const std::uint32_t node = f.on_edges.front();
             for (std::size_t corner = 0; corner < 3; ++corner) {
                 Filled copy = f;
                 move_beyond(copy, node, corner);
                 if (text_of(violations_of(copy)).find("folded_faces") != std::string::npos) {
                     f = copy;
                     return;
                 }
             }
         }},
    };
}

/// Lists damage to corners, to nodes inside blocks, and to copies of nodes.
std::vector<Damage> damage_to_other_nodes() {
    return {
        {"an input vertex moved by one ulp", Defect::missing_vertex,
         [](Filled& f) {
             double& x = f.tetrahedra.vertices[corner_node(f)].x;
             x = std::nextafter(x, 1e300);
         }},
        {"an input vertex moved by 1e-6", Defect::missing_vertex,
         [](Filled& f) { f.tetrahedra.vertices[corner_node(f)].y += 1e-6; }},
        {"a node inside moved to the other side of a surface", Defect::no_volume,
         [](Filled& f) {
             const std::uint32_t face = largest_faces(f).front();
             const Point3 n = normal(f, f.tetrahedra.face_triangle[face]);
             for (const std::uint32_t node : f.inside)
                 for (const double side : {-1.0, 1.0})
                     f.tetrahedra.vertices[node] = sum(
                         f.tetrahedra.vertices[f.tetrahedra.faces[face][0]], n, side * size_of(f));
         }},
        {"a node doubled for one tetrahedron", Defect::doubled_node,
         [](Filled& f) {
             const std::uint32_t node = f.tetrahedra.tetrahedra[0][0];
             copy_node(f, node, [](std::uint32_t t) { return t == 0; });
         }},
        {"a node doubled for a whole block", Defect::open_face,
         [](Filled& f) {
             const auto block = f.tetrahedra.block_of;
             copy_node(f, f.on_faces.front(), [&](std::uint32_t t) { return block[t] == 1; });
         }},
        {"a copy that is larger by 2^-30", Defect::missing_vertex,
         [](Filled& f) { move_all(f, [](const Point3& p) { return sum(p, p, 0x1p-30); }); }},
        {"a copy moved by .001 along x", Defect::missing_vertex,
         [](Filled& f) {
             move_all(f, [](const Point3& p) { return Point3{p.x + .001, p.y, p.z}; });
         }},
        {"a corner of the box moved outward", Defect::stray_face,
         [](Filled& f) {
             auto& v = f.tetrahedra.vertices;
             const auto most = std::max_element(v.begin(), v.end());
             most->x += size_of(f);
         },
         true},
        {"a node that is not finite", Defect::unusable_lists,
         [](Filled& f) {
             f.tetrahedra.vertices[f.inside.front()].z = std::numeric_limits<double>::quiet_NaN();
         }},
    };
}

} // namespace

std::vector<Damage> damage_to_nodes() {
    return joined(damage_to_nodes_on_triangles(), damage_to_other_nodes());
}

} // namespace test_support
