// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/side_sets.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>

namespace terrane::detail {

namespace {

/// Returns the element faces of each surface: in front of it, and behind it.
std::vector<std::array<SideSet, 2>> sides_of_surfaces(const TetrahedralMesh& mesh) {
    const auto sides = sides_of_faces(mesh);
    std::vector<std::array<SideSet, 2>> sets(mesh.surfaces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (const auto s : mesh.surfaces_of[f])
            for (const std::size_t k : {0, 1}) {
                const auto& side = k == 0 ? sides[f].front : sides[f].back;
                if (!side.exists()) continue;
                sets[s][k].sides.push_back(side);
                sets[s][k].faces.push_back(f);
            }
    return sets;
}

void add_side_sets(const TetrahedralMesh& mesh, NamedParts& parts) {
    auto sets = sides_of_surfaces(mesh);
    for (std::uint32_t s = 0; s < sets.size(); ++s) {
        const bool two_sided = !sets[s][0].sides.empty() && !sets[s][1].sides.empty();
        for (const std::size_t k : {0, 1}) {
            SideSet& set = sets[s][k];
            if (set.sides.empty()) continue;
            set.surface = s;
            set.side = !two_sided ? CutSide::none : k == 0 ? CutSide::front : CutSide::back;
            set.tag = side_tag(s, set.side, mesh.surfaces.size());
            set.name = parts.surfaces[s];
            if (two_sided)
                set.name = parts.names.add(set.name + (k == 0 ? "_front" : "_back"), "surface");
            parts.side_sets.push_back(std::move(set));
        }
    }
}

void add_blocks(const TetrahedralMesh& mesh, std::span<const std::string> block_names,
                NamedParts& parts) {
    std::vector<ElementBlock> blocks;
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
        const auto block = mesh.block_of[t];
        if (block >= blocks.size()) blocks.resize(block + 1);
        blocks[block].tetrahedra.push_back(t);
    }
    const std::size_t after = std::max<std::size_t>(mesh.block_count, blocks.size());
    for (std::uint32_t r = 0; r < blocks.size(); ++r) {
        if (blocks[r].tetrahedra.empty()) continue;
        blocks[r].block = r;
        blocks[r].number = r == 0 ? after : r;
        const bool named = r < block_names.size() && !block_names[r].empty();
        blocks[r].name = parts.names.add(named ? block_names[r] : block_name(r), "block");
        parts.blocks.push_back(std::move(blocks[r]));
    }
}

Edge edge_between(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

template <class Use>
void for_each_edge(const Triangle& corners, const Use& use) {
    for (std::size_t k = 0; k < 3; ++k) use(edge_between(corners[k], corners[(k + 1) % 3]));
}

Triangle sorted(Triangle corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Returns the edges of all faces with one tetrahedron that are not on a cut, sorted.
std::vector<Edge> border_edges(const TetrahedralMesh& mesh) {
    std::vector<Triangle> sides, cut;
    for (const auto& twins : mesh.twins)
        for (const auto face : twins) cut.push_back(sorted(mesh.faces[face]));
    sort_unique(cut);
    for (const auto& v : mesh.tetrahedra)
        for (const auto& [i, j, k] : corners_of_side) sides.push_back(sorted({v[i], v[j], v[k]}));
    std::sort(sides.begin(), sides.end());
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool twice = (i > 0 && sides[i - 1] == sides[i]) ||
                           (i + 1 < sides.size() && sides[i + 1] == sides[i]);
        if (!twice && !std::binary_search(cut.begin(), cut.end(), sides[i]))
            for_each_edge(sides[i], [&](const Edge& edge) { edges.push_back(edge); });
    }
    sort_unique(edges);
    return edges;
}

} // namespace

NamedParts named_parts(const TetrahedralMesh& mesh, std::span<const std::string> block_names) {
    NamedParts parts;
    for (const SurfaceInfo& surface : mesh.surfaces)
        parts.surfaces.push_back(parts.names.add(surface.name, "surface"));
    add_side_sets(mesh, parts);
    add_blocks(mesh, block_names, parts);
    return parts;
}

std::vector<std::uint32_t> nodes_of_face(const TetrahedralMesh& mesh, const EdgeNodes* nodes,
                                         std::size_t face) {
    std::vector<std::uint32_t> all(mesh.faces[face].begin(), mesh.faces[face].end());
    if (nodes) all.insert(all.end(), nodes->of_faces[face].begin(), nodes->of_faces[face].end());
    return all;
}

std::vector<std::uint32_t> outward_nodes(const TetrahedralMesh& mesh, const EdgeNodes* nodes,
                                         const TetrahedronSide& side) {
    const auto& [i, j, k] = corners_of_side[side.side]; // counterclockwise seen from inside
    const std::array<unsigned, 3> corners{i, k, j};
    std::vector<std::uint32_t> all;
    for (const auto c : corners) all.push_back(mesh.tetrahedra[side.tetrahedron][c]);
    if (!nodes) return all;
    for (std::size_t n = 0; n < 3; ++n)
        for (std::size_t e = 0; e < 6; ++e) {
            const auto& [a, b] = corners_of_edge[e];
            if (edge_between(a, b) == edge_between(corners[n], corners[(n + 1) % 3]))
                all.push_back(nodes->of_tetrahedra[side.tetrahedron][e]);
        }
    return all;
}

std::vector<std::uint32_t> nodes_of_faces(const TetrahedralMesh& mesh, const EdgeNodes* nodes,
                                          std::span<const std::uint32_t> faces) {
    std::vector<std::uint32_t> all;
    for (const auto face : faces)
        for (const auto node : nodes_of_face(mesh, nodes, face)) all.push_back(node);
    sort_unique(all);
    return all;
}

std::vector<std::vector<std::uint32_t>> faces_of_surfaces(const TetrahedralMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> faces(mesh.surfaces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (const auto s : mesh.surfaces_of[f]) faces[s].push_back(f);
    return faces;
}

std::vector<std::vector<Edge>> buried_edges(const TetrahedralMesh& mesh) {
    const auto border = border_edges(mesh);
    std::vector<bool> is_behind(mesh.faces.size(), false);
    for (const auto& twins : mesh.twins) is_behind[twins[1]] = true;
    std::vector<std::vector<Edge>> buried;
    for (const auto& faces : faces_of_surfaces(mesh)) {
        std::vector<Edge> edges;
        for (const auto face : faces)
            if (!is_behind[face])
                for_each_edge(mesh.faces[face], [&](const Edge& edge) { edges.push_back(edge); });
        std::sort(edges.begin(), edges.end());
        auto& ends = buried.emplace_back();
        for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
            while (end < edges.size() && edges[end] == edges[i]) ++end;
            if (end == i + 1 && !std::binary_search(border.begin(), border.end(), edges[i]))
                ends.push_back(edges[i]);
        }
    }
    return buried;
}

} // namespace terrane::detail
