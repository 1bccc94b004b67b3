// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/tetrahedra_damage.hpp"

namespace test_support {
namespace {

using Defect = TetrahedraDefect;

/// Keeps the faces for which this holds.
template <class Which>
void keep_faces(Filled& f, const Which& which) {
    TetrahedralMesh& m = f.tetrahedra;
    std::vector<Triangle> faces;
    std::vector<std::uint32_t> face_triangle;
    IndexLists<std::uint32_t> surfaces_of;
    for (std::uint32_t i = 0; i < m.faces.size(); ++i) {
        if (!which(i)) continue;
        faces.push_back(m.faces[i]);
        face_triangle.push_back(m.face_triangle[i]);
        surfaces_of.push_back(m.surfaces_of[i]);
    }
    m.faces = faces;
    m.face_triangle = face_triangle;
    m.surfaces_of = surfaces_of;
}

void list_face(Filled& f, const Triangle& face, std::uint32_t triangle) {
    TetrahedralMesh& m = f.tetrahedra;
    m.faces.push_back(face);
    m.face_triangle.push_back(triangle);
    m.surfaces_of.push_back(f.mesh.surfaces_of[triangle]);
}

/// The first face that has a node.
std::uint32_t face_at(const Filled& f, std::uint32_t node) {
    const auto& faces = f.tetrahedra.faces;
    for (std::uint32_t i = 0; i < faces.size(); ++i)
        if (has_all(faces[i], std::array{node})) return i;
    FAIL("no face");
    return 0;
}

/// Lists faces for one of the triangles at a divided edge that do not divide the edge: a single
/// one, or three round another node.
void tear_edge(Filled& f, bool in_three) {
    const auto of = f.tetrahedra.face_triangle;
    const std::uint32_t triangle = of[face_at(f, f.on_edges.back())];
    const auto& v = f.tetrahedra.vertices;
    Triangle whole{};
    for (std::size_t k = 0; k < 3; ++k)
        whole[k] = static_cast<std::uint32_t>(
            std::find(v.begin(), v.end(), f.mesh.vertices[f.mesh.triangles[triangle][k]]) -
            v.begin());
    keep_faces(f, [&](std::uint32_t i) { return of[i] != triangle; });
    if (!in_three) return list_face(f, whole, triangle);
    for (std::size_t k = 0; k < 3; ++k)
        list_face(f, {whole[k], whole[(k + 1) % 3], f.inside[0]}, triangle);
}

void exchange_blocks(Filled& f, std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t& r : f.tetrahedra.block_of) r = r == a ? b : r == b ? a : r;
}

} // namespace

namespace {

/// Lists damage to what faces say.
std::vector<Damage> damage_to_faces() {
    return {
        {"the triangles of two faces swapped", Defect::broken_outline,
         [](Filled& f) {
             const auto large = largest_faces(f);
             auto& of = f.tetrahedra.face_triangle;
             const auto other = std::find_if(large.begin(), large.end(), [&](std::uint32_t i) {
                 return of[i] != of[large[0]];
             });
             std::swap(of[large[0]], of[*other]);
         }},
        {"a face with the surface of another one", Defect::wrong_attributes,
         [](Filled& f) { ++f.tetrahedra.surfaces_of.values[0]; }},
        {"a surface with another name", Defect::wrong_attributes,
         [](Filled& f) { f.tetrahedra.surfaces[0].name += "'"; }},
        {"a wrong number of blocks", Defect::wrong_attributes,
         [](Filled& f) { ++f.tetrahedra.block_count; }},
        {"a triangle without faces", Defect::uncovered_triangle,
         [](Filled& f) {
             const auto of = f.tetrahedra.face_triangle;
             keep_faces(f, [&](std::uint32_t i) { return of[i] != of[0]; });
         }},
        {"a triangle without one of its faces", Defect::node_off_edge,
         [](Filled& f) {
             keep_faces(f, [at = face_at(f, f.on_faces[0])](std::uint32_t i) { return i != at; });
         }},
        {"an edge that one of its triangles does not divide", Defect::torn_edge,
         [](Filled& f) { tear_edge(f, false); }},
        {"an edge that two divided triangles divide in different ways", Defect::torn_edge,
         [](Filled& f) { tear_edge(f, true); }},
        {"a triangle covered by a face that is no face", Defect::stray_face,
         [](Filled& f) { tear_edge(f, false); }},
        {"a face listed twice", Defect::stray_face,
         [](Filled& f) {
             const std::uint32_t at = largest_faces(f).front();
             list_face(f, Triangle(f.tetrahedra.faces[at]), f.tetrahedra.face_triangle[at]);
         }},
        {"a face wound the other way", Defect::wrong_block,
         [](Filled& f) {
             Triangle& face = f.tetrahedra.faces[largest_faces(f).front()];
             std::swap(face[0], face[1]);
         }},
        {"a face of a surface called one of the box", Defect::stray_face,
         [](Filled& f) { f.tetrahedra.face_triangle[largest_faces(f).front()] = UINT32_MAX; }},
        {"a face inside a block listed on a triangle", Defect::broken_outline,
         [](Filled& f) {
             const auto& corners = f.tetrahedra.tetrahedra;
             const auto at = std::find_if(corners.begin(), corners.end(), [&](const auto& t) {
                 return has_all(t, std::array{f.inside[0]});
             });
             Triangle face{(*at)[0], (*at)[1], (*at)[2]};
             if (!has_all(face, std::array{f.inside[0]})) face[0] = f.inside[0];
             list_face(f, face, f.tetrahedra.face_triangle[largest_faces(f).front()]);
         }},
        {"faces that cover another triangle than they name", Defect::broken_outline,
         [](Filled& f) { std::swap(f.mesh.triangles[0], f.mesh.triangles[1]); }},
    };
}

/// Lists damage to what blocks and lists say.
std::vector<Damage> damage_to_blocks() {
    return {
        {"the block of one tetrahedron changed", Defect::wrong_block,
         [](Filled& f) {
             auto& block = f.tetrahedra.block_of;
             *std::find(block.begin(), block.end(), 1U) = 0;
         }},
        {"a block exchanged with the outside", Defect::wrong_block,
         [](Filled& f) { exchange_blocks(f, 0, 1); }},
        {"a block renumbered", Defect::wrong_block,
         [](Filled& f) {
             exchange_blocks(f, 1, static_cast<std::uint32_t>(f.volumes.measures.size()) - 1);
             if (f.volumes.measures.size() == 2) exchange_blocks(f, 0, 1);
         }},
        {"blocks that the volumes do not tell apart", Defect::wrong_block,
         [](Filled& f) {
             for (auto& sides : f.volumes.of_sides) sides = {0, 0};
         }},
        {"a block that is none", Defect::unusable_lists,
         [](Filled& f) {
             f.tetrahedra.block_of[0] = static_cast<std::uint32_t>(f.volumes.measures.size());
         }},
        {"a face that names no triangle", Defect::unusable_lists,
         [](Filled& f) {
             f.tetrahedra.face_triangle[0] = static_cast<std::uint32_t>(f.mesh.triangles.size());
         }},
        {"lists of different lengths", Defect::unusable_lists,
         [](Filled& f) { f.tetrahedra.face_triangle.pop_back(); }},
    };
}

} // namespace

std::vector<Damage> damage_to_attributes() {
    return joined(damage_to_faces(), damage_to_blocks());
}

std::vector<Damage> damage_to_cuts() {
    return {
        {"a pair of twins left out", Defect::wrong_twins,
         [](Filled& f) { f.tetrahedra.twins.erase(f.tetrahedra.twins.begin()); }},
        {"all twins left out", Defect::doubled_node, [](Filled& f) { f.tetrahedra.twins.clear(); }},
        {"faces behind exchanged between two pairs of twins", Defect::wrong_twins,
         [](Filled& f) { std::swap(f.tetrahedra.twins[0][1], f.tetrahedra.twins[1][1]); }},
        {"twins in the wrong order", Defect::wrong_twins,
         [](Filled& f) { std::swap(f.tetrahedra.twins[0][0], f.tetrahedra.twins[0][1]); }},
        {"a node behind a cut moved by one ulp", Defect::open_face,
         [](Filled& f) {
             double& x = f.tetrahedra.vertices.back().x;
             x = std::nextafter(x, 1e300);
         }},
        {"a node of a cut shared again", Defect::wrong_twins,
         [](Filled& f) {
             TetrahedralMesh& m = f.tetrahedra;
             const auto last = static_cast<std::uint32_t>(m.vertices.size() - 1);
             const auto first = static_cast<std::uint32_t>(
                 std::find(m.vertices.begin(), m.vertices.end(), m.vertices[last]) -
                 m.vertices.begin());
             for (auto& t : m.tetrahedra) std::replace(t.begin(), t.end(), last, first);
             for (auto& face : m.faces) std::replace(face.begin(), face.end(), last, first);
         }},
        {"a face behind a cut with the nodes in front", Defect::wrong_twins,
         [](Filled& f) {
             const auto [front, back] = f.tetrahedra.twins[0];
             f.tetrahedra.faces[back] = f.tetrahedra.faces[front];
         }},
        {"a face behind a cut with one node in front", Defect::wrong_twins,
         [](Filled& f) {
             for (const auto& [front, back] : f.tetrahedra.twins)
                 for (std::size_t k = 0; k < 3; ++k)
                     if (f.tetrahedra.faces[back][k] != f.tetrahedra.faces[front][k]) {
                         f.tetrahedra.faces[back][k] = f.tetrahedra.faces[front][k];
                         return;
                     }
         }},
        {"nodes of one tetrahedron apart where no cut is", Defect::wrong_twins,
         [](Filled& f) {
             TetrahedralMesh& m = f.tetrahedra;
             const std::uint32_t node = f.inside.front();
             const auto at =
                 std::find_if(m.tetrahedra.begin(), m.tetrahedra.end(),
                              [&](const auto& t) { return has_all(t, std::array{node}); });
             std::replace(at->begin(), at->end(), node,
                          static_cast<std::uint32_t>(m.vertices.size()));
             m.vertices.push_back(Point3(m.vertices[node]));
         }},
    };
}

} // namespace test_support
