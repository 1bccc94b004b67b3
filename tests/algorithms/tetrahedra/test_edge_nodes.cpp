// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <limits>
#include <set>

#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// Returns the node between two corners of a tetrahedron.
std::uint32_t between(const EdgeNodes& nodes, const TetrahedralMesh& mesh, std::size_t t,
                      std::uint32_t a, std::uint32_t b) {
    for (std::size_t e = 0; e < 6; ++e) {
        const auto& [i, j] = corners_of_edge[e];
        const std::set<std::uint32_t> ends{mesh.tetrahedra[t][i], mesh.tetrahedra[t][j]};
        if (ends == std::set<std::uint32_t>{a, b}) return nodes.of_tetrahedra[t][e];
    }
    FAIL("no edge " << a << ", " << b << " of tetrahedron " << t);
    return 0;
}

/// Returns four tetrahedra round the edge from 0 to 1, of which the first two and the last two hang
/// together; the two faces between them at vertex 2, and those at vertex 4, are split: but for the
/// ends of the edge, nodes are doubled.
TetrahedralMesh cut_through_an_edge() {
    TetrahedralMesh mesh;
    mesh.surfaces = {{"fault", Role::fault}};
    mesh.vertices = {{0, 0, 0},  {0, 0, 1},  {1, 0, 0}, {0, 1, 0},
                     {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}};
    mesh.tetrahedra = {{0, 2, 3, 1}, {0, 3, 4, 1}, {0, 7, 5, 1}, {0, 5, 6, 1}};
    mesh.block_of = {1, 1, 1, 1};
    mesh.faces = {{0, 2, 1}, {0, 4, 1}, {0, 6, 1}, {0, 7, 1}};
    mesh.face_triangle = {0, 1, 0, 1};
    for (int f = 0; f < 4; ++f) mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    mesh.twins = {{0, 2}, {1, 3}};
    mesh.block_count = 2;
    return mesh;
}

} // namespace

TEST_CASE("edge nodes: one in the middle of each edge", "[edge_nodes]") {
    const auto mesh = two_tetrahedra();
    const auto nodes = find_edge_nodes(mesh);
    REQUIRE(nodes);
    CHECK(nodes->vertices.size() == 5 + 9); // 9 edges, of which 3 have both tetrahedra
    for (std::size_t t = 0; t < 2; ++t)
        for (std::size_t e = 0; e < 6; ++e) {
            const auto& [i, j] = corners_of_edge[e];
            const auto& a = mesh.vertices[mesh.tetrahedra[t][i]];
            const auto& b = mesh.vertices[mesh.tetrahedra[t][j]];
            CHECK(nodes->vertices[nodes->of_tetrahedra[t][e]] ==
                  Point3{a.x / 2 + b.x / 2, a.y / 2 + b.y / 2, a.z / 2 + b.z / 2});
        }
    for (const auto& [a, b] : {Edge{0, 1}, Edge{1, 2}, Edge{0, 2}})
        CHECK(between(*nodes, mesh, 0, a, b) == between(*nodes, mesh, 1, a, b));
    CHECK(nodes->of_faces[0][1] == between(*nodes, mesh, 0, 1, 2));
    CHECK(nodes->of_faces[1][2] == between(*nodes, mesh, 0, 3, 0));
}

TEST_CASE("edge nodes: those of a cut are split with it", "[edge_nodes]") {
    const auto mesh = cut_tetrahedra();
    const auto nodes = find_edge_nodes(mesh);
    REQUIRE(nodes);
    CHECK(nodes->vertices.size() == 7 + 12);
    CHECK(between(*nodes, mesh, 0, 1, 2) != between(*nodes, mesh, 1, 5, 6));
    const auto pairs = node_pairs(mesh, *nodes);
    CHECK(pairs[0].size() == 2 + 3);
    CHECK(pairs[0] == pairs[1]);
    for (const auto& [front, back] : pairs[0])
        CHECK(nodes->vertices[front] == nodes->vertices[back]);
}

TEST_CASE("edge nodes: an edge between two tips is cut by the faces at it", "[edge_nodes]") {
    const auto mesh = cut_through_an_edge();
    const auto nodes = find_edge_nodes(mesh);
    REQUIRE(nodes);
    CHECK(between(*nodes, mesh, 0, 0, 1) == between(*nodes, mesh, 1, 0, 1));
    CHECK(between(*nodes, mesh, 2, 0, 1) == between(*nodes, mesh, 3, 0, 1));
    CHECK(between(*nodes, mesh, 0, 0, 1) != between(*nodes, mesh, 2, 0, 1));
    CHECK(nodes->of_faces[0][2] == between(*nodes, mesh, 0, 0, 1));
    CHECK(nodes->of_faces[2][2] == between(*nodes, mesh, 3, 0, 1));

    auto tip = mesh; // the surface ends at the edge: its other half is not split
    tip.twins = {{0, 2}};
    tip.tetrahedra[2][1] = 4;
    tip.faces[3] = tip.faces[1];
    const auto at_tip = find_edge_nodes(tip);
    REQUIRE(at_tip);
    for (std::size_t t = 1; t < 4; ++t)
        CHECK(between(*at_tip, tip, t, 0, 1) == between(*at_tip, tip, 0, 0, 1));

    auto touching = mesh; // blocks that meet along the edge alone
    touching.twins.clear();
    const auto shared = find_edge_nodes(touching);
    REQUIRE(shared);
    CHECK(between(*shared, touching, 0, 0, 1) == between(*shared, touching, 2, 0, 1));
}

TEST_CASE("edge nodes: no sum is beyond the largest double", "[edge_nodes]") {
    auto mesh = two_tetrahedra();
    for (auto& p : mesh.vertices) p.x += 1.7e308;
    const auto nodes = find_edge_nodes(mesh);
    REQUIRE(nodes);
    for (const auto& p : nodes->vertices) CHECK(p.x < std::numeric_limits<double>::infinity());
}

TEST_CASE("edge nodes: a face of no tetrahedron is refused", "[edge_nodes]") {
    auto mesh = two_tetrahedra();
    mesh.faces[1] = {1, 2, 4};
    mesh.faces[0] = {1, 3, 4};
    const auto nodes = find_edge_nodes(mesh);
    CHECK(message_of(nodes) == "face 0 is no face of a tetrahedron");
    REQUIRE(!nodes);
    CHECK(nodes.error().code == ErrorCode::bad_index);
}
