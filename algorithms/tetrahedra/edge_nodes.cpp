// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/face_sides.hpp>

namespace terrane {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// An edge of a tetrahedron.
struct EdgeUse {
    Edge edge{};                   ///< the lower vertex first
    std::uint32_t tetrahedron = 0; ///< index
    std::uint32_t side = 0;        ///< index into corners_of_edge

    friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

Edge edge_of(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

Corners ascending(Corners corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

std::vector<EdgeUse> sorted_uses(const TetrahedralMesh& mesh) {
    std::vector<EdgeUse> uses;
    uses.reserve(6 * mesh.tetrahedra.size());
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
        for (std::uint32_t e = 0; e < 6; ++e) {
            const auto& [i, j] = corners_of_edge[e];
            uses.push_back({edge_of(mesh.tetrahedra[t][i], mesh.tetrahedra[t][j]), t, e});
        }
    std::sort(uses.begin(), uses.end());
    return uses;
}

/// The faces on cuts, by their sorted corners, and their edges.
struct CutFaces {
    explicit CutFaces(const TetrahedralMesh& mesh) {
        for (const auto& twins : mesh.twins)
            for (const auto face : twins) {
                const auto& c = mesh.faces[face];
                faces.push_back(ascending(c));
                for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_of(c[k], c[(k + 1) % 3]));
            }
        sort_unique(faces);
        sort_unique(edges);
    }
    std::vector<Corners> faces;
    std::vector<Edge> edges;
};

/// Returns, for each tetrahedron at an edge, the first one that shares its node there, as indices
/// into `uses` (1), (2).
std::vector<std::uint32_t> sectors(const TetrahedralMesh& mesh, std::span<const EdgeUse> uses,
                                   const CutFaces& cut) {
    struct Fin {
        std::uint32_t apex = 0; ///< the third corner of a face at the edge
        std::uint32_t use = 0;
    };
    const Edge& edge = uses[0].edge;
    std::vector<Fin> fins;
    for (std::uint32_t u = 0; u < uses.size(); ++u)
        for (const auto v : mesh.tetrahedra[uses[u].tetrahedron])
            if (v != edge[0] && v != edge[1]) fins.push_back({v, u});
    std::sort(fins.begin(), fins.end(), [](const Fin& a, const Fin& b) {
        return std::pair(a.apex, a.use) < std::pair(b.apex, b.use);
    });
    DisjointSets sets(uses.size());
    std::vector<bool> at_cut(uses.size(), false);
    for (std::size_t i = 0; i < fins.size(); ++i) {
        if (i > 0 && fins[i].apex == fins[i - 1].apex) sets.join(fins[i].use, fins[i - 1].use);
        const auto face = ascending({edge[0], edge[1], fins[i].apex});
        if (std::binary_search(cut.faces.begin(), cut.faces.end(), face))
            at_cut[fins[i].use] = true;
    }
    for (std::uint32_t u = 0; u < uses.size(); ++u)
        if (at_cut[u]) at_cut[sets.find(u)] = true;
    std::uint32_t free = UINT32_MAX; // the first sector that touches no cut
    for (std::uint32_t u = 0; u < uses.size(); ++u) {
        if (sets.find(u) != u || at_cut[u]) continue;
        if (free == UINT32_MAX) free = u;
        sets.join(free, u);
    }
    return sets.flattened();
}

/// Gives the tetrahedra at one edge their nodes.
void add_nodes(const TetrahedralMesh& mesh, std::span<const EdgeUse> uses, const CutFaces& cut,
               EdgeNodes& nodes) {
    const Edge& edge = uses[0].edge;
    std::vector<std::uint32_t> first(uses.size(), 0); // nearly always one node for all
    if (std::binary_search(cut.edges.begin(), cut.edges.end(), edge))
        first = sectors(mesh, uses, cut);
    const Point3 &a = mesh.vertices[edge[0]], &b = mesh.vertices[edge[1]];
    for (std::uint32_t u = 0; u < uses.size(); ++u) {
        auto& node = nodes.of_tetrahedra[uses[u].tetrahedron][uses[u].side];
        if (first[u] != u) { // halves first, as a sum could be beyond the largest double
            const auto& earlier = uses[first[u]];
            node = nodes.of_tetrahedra[earlier.tetrahedron][earlier.side];
            continue;
        }
        node = static_cast<std::uint32_t>(nodes.vertices.size());
        nodes.vertices.push_back({a.x / 2 + b.x / 2, a.y / 2 + b.y / 2, a.z / 2 + b.z / 2});
    }
}

/// Returns the node between two corners of a tetrahedron.
std::uint32_t node_between(const TetrahedralMesh& mesh, const EdgeNodes& nodes, std::uint32_t t,
                           std::uint32_t a, std::uint32_t b) {
    std::size_t e = 0;
    const auto& corners = mesh.tetrahedra[t];
    while (e < 5 &&
           edge_of(corners[corners_of_edge[e][0]], corners[corners_of_edge[e][1]]) != edge_of(a, b))
        ++e;
    return nodes.of_tetrahedra[t][e];
}

} // namespace

Result<EdgeNodes> find_edge_nodes(const TetrahedralMesh& mesh) {
    return guarded("for nodes on edges", "nodes", [&]() -> Result<EdgeNodes> {
        const auto uses = sorted_uses(mesh);
        if (mesh.vertices.size() + uses.size() >= UINT32_MAX)
            return Error{
                ErrorCode::unsupported,
                "these are too many tetrahedra for nodes of second order: 32 bits number them", ""};
        const CutFaces cut(mesh);
        EdgeNodes nodes;
        nodes.vertices = mesh.vertices;
        nodes.of_tetrahedra.resize(mesh.tetrahedra.size());
        for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
            while (end < uses.size() && uses[end].edge == uses[i].edge) ++end;
            add_nodes(mesh, std::span(uses).subspan(i, end - i), cut, nodes);
        }
        const auto sides = sides_of_faces(mesh);
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            const auto& side = sides[f].front.exists() ? sides[f].front : sides[f].back;
            if (!side.exists())
                return Error{ErrorCode::bad_index,
                             fmt::format("face {} is no face of a tetrahedron", f), ""};
            const auto& c = mesh.faces[f];
            auto& of_face = nodes.of_faces.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                of_face[k] = node_between(mesh, nodes, side.tetrahedron, c[k], c[(k + 1) % 3]);
        }
        return nodes;
    });
}

std::vector<std::vector<NodePair>> node_pairs(const TetrahedralMesh& mesh, const EdgeNodes& nodes) {
    auto pairs = node_pairs(mesh);
    for (const auto& [front, back] : mesh.twins)
        for (const auto s : mesh.surfaces_of[front])
            for (std::size_t k = 0; k < 3; ++k)
                if (nodes.of_faces[front][k] != nodes.of_faces[back][k])
                    pairs[s].push_back({nodes.of_faces[front][k], nodes.of_faces[back][k]});
    for (auto& list : pairs) sort_unique(list);
    return pairs;
}

} // namespace terrane
