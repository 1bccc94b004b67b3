// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/abaqus.hpp>

#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/face_sides.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/meshes/detail/second_order.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::size_t most_per_line = 16; ///< numbers that a data line of a set may have

std::string node_lines(const std::vector<Point3>& vertices) {
    std::string out = "*HEADING\nTerrane\n*NODE\n";
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        append_number(out, std::uint64_t(v + 1));
        for (const double x : {vertices[v].x, vertices[v].y, vertices[v].z}) {
            out += ", ";
            append_number(out, x);
        }
        out += '\n';
    }
    return out;
}

template <class Cell>
void append_element(std::string& out, std::size_t index, const Cell& corners) {
    append_number(out, std::uint64_t(index + 1));
    for (const auto v : corners) {
        out += ", ";
        append_number(out, std::uint64_t(v) + 1);
    }
    out += '\n';
}

void append_set(std::string& out, const std::vector<std::uint32_t>& members) {
    for (std::size_t i = 0; i < members.size(); ++i) {
        append_number(out, std::uint64_t(members[i]) + 1);
        out += i + 1 == members.size() || (i + 1) % most_per_line == 0 ? "\n" : ", ";
    }
}

void append_side(std::string& out, const std::string& name,
                 const std::vector<TetrahedronSide>& sides) {
    if (sides.empty()) return;
    out += fmt::format("*SURFACE, TYPE=ELEMENT, NAME={}\n", name);
    for (const TetrahedronSide& s : sides)
        out += fmt::format("{}, S{}\n", s.tetrahedron + 1, s.side + 1);
}

/// The nodes of a surface, and the element faces on its two sides.
struct Members {
    std::vector<std::uint32_t> nodes;
    std::vector<TetrahedronSide> front, back;
};

std::vector<Members> members_of_surfaces(const TetrahedralMesh& mesh, const EdgeNodes* edge_nodes) {
    const auto sides = sides_of_faces(mesh);
    std::vector<Members> members(mesh.surfaces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (const auto s : mesh.surfaces_of[f]) {
            auto& [nodes, front, back] = members[s];
            for (const auto node : nodes_of_face(mesh, edge_nodes, f)) nodes.push_back(node);
            if (sides[f].front.exists()) front.push_back(sides[f].front);
            if (sides[f].back.exists()) back.push_back(sides[f].back);
        }
    for (auto& m : members) sort_unique(m.nodes);
    return members;
}

/// Appends two node sets in the order of the pairs; Abaqus would sort them without UNSORTED.
void append_pairs(std::string& out, const std::string& name, const std::vector<NodePair>& pairs) {
    if (pairs.empty()) return;
    for (const std::size_t side : {0, 1}) {
        out +=
            fmt::format("*NSET, NSET={}_PAIRS_{}, UNSORTED\n", name, side == 0 ? "FRONT" : "BACK");
        std::vector<std::uint32_t> nodes;
        for (const NodePair& pair : pairs) nodes.push_back(pair[side]);
        append_set(out, nodes);
    }
}

/// Returns the lines of the node set and of the element faces of each surface.
std::string surface_lines(const TetrahedralMesh& mesh, const EdgeNodes* nodes) {
    const auto names = label_names(mesh.surfaces);
    const auto members = members_of_surfaces(mesh, nodes);
    const auto pairs = nodes ? node_pairs(mesh, *nodes) : node_pairs(mesh);
    std::string out;
    for (std::size_t s = 0; s < names.size(); ++s) {
        if (members[s].nodes.empty()) continue;
        out += fmt::format("*NSET, NSET={}\n", names[s]);
        append_set(out, members[s].nodes);
        append_side(out, names[s] + "_FRONT", members[s].front);
        append_side(out, names[s] + "_BACK", members[s].back);
        append_pairs(out, names[s], pairs[s]);
    }
    return out;
}

/// Returns the names of the element sets of `count` blocks.
std::vector<std::string> set_names(std::size_t count, std::span<const std::string> block_names) {
    std::vector<SurfaceInfo> infos; // the names as label_names takes them
    for (std::size_t r = 0; r < count; ++r) {
        const bool named = r < block_names.size() && !block_names[r].empty();
        infos.push_back({named ? block_names[r] : block_name(r), Role::unknown});
    }
    return label_names(infos);
}

} // namespace

std::string to_abaqus(const Mesh& mesh) {
    auto out = node_lines(mesh.vertices);
    out += "*ELEMENT, TYPE=S3\n";
    std::vector<std::vector<std::uint32_t>> elements(mesh.surfaces.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        append_element(out, t, mesh.triangles[t]);
        for (const auto s : mesh.surfaces_of[t]) elements[s].push_back(t);
    }
    const auto names = label_names(mesh.surfaces);
    for (std::size_t s = 0; s < names.size(); ++s) {
        if (elements[s].empty()) continue;
        out += fmt::format("*ELSET, ELSET={}\n", names[s]);
        append_set(out, elements[s]);
    }
    return out;
}

std::string to_abaqus(const TetrahedralMesh& mesh, std::span<const std::string> block_names,
                      const EdgeNodes* nodes) {
    std::map<std::uint32_t, std::vector<std::size_t>> of_region;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
        of_region[mesh.block_of[t]].push_back(t);
    const auto names =
        set_names(of_region.empty() ? 0 : of_region.rbegin()->first + 1, block_names);
    auto out = node_lines(nodes ? nodes->vertices : mesh.vertices);
    const auto cells = nodes ? tetrahedra_of_10(mesh, *nodes, order_of_abaqus)
                             : std::vector<std::array<std::uint32_t, 10>>();
    for (const auto& [block, tetrahedra] : of_region) {
        out += fmt::format("** {}\n*ELEMENT, TYPE={}, ELSET={}\n", block_name(block, block_names),
                           nodes ? "C3D10" : "C3D4", names[block]);
        for (const std::size_t t : tetrahedra)
            if (nodes)
                append_element(out, t, cells[t]);
            else
                append_element(out, t, mesh.tetrahedra[t]);
    }
    return out + surface_lines(mesh, nodes);
}

} // namespace terrane
