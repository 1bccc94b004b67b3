// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/abaqus.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/sets.hpp>
#include <terrane/io/groups.hpp>
#include <terrane/io/names.hpp>
#include <terrane/io/text.hpp>

namespace terrane {

using namespace detail;

namespace {

using Tetrahedron = std::array<std::uint32_t, 4>;

constexpr std::size_t most_per_line = 16; ///< numbers that a data line of a set may have

/// Corners of faces S1 to S4. Each has its element in front, where its orientation is positive.
constexpr std::array<std::array<unsigned, 3>, 4> corners_of_side{
    {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

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

struct Side {
    std::uint32_t tetrahedron = 0;
    unsigned number = 0; ///< 1 to 4
};

/// Per face the sides of tetrahedra on it.
struct SidesOfFace {
    std::vector<Side> front, back;
};

Triangle turned(Triangle t) { // the least corner first, the same winding
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

std::vector<SidesOfFace> sides_of_faces(const TetrahedralMesh& mesh) {
    std::vector<std::pair<Triangle, std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        faces.emplace_back(turned(mesh.faces[f]), f);
    std::sort(faces.begin(), faces.end());
    std::vector<SidesOfFace> found(mesh.faces.size());
    const auto find = [&](const Triangle& key) {
        const auto at = std::lower_bound(faces.begin(), faces.end(), std::pair(key, 0U));
        return at != faces.end() && at->first == key ? at : faces.end();
    };
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
        for (unsigned side = 0; side < 4; ++side) {
            const auto& [i, j, k] = corners_of_side[side];
            const Tetrahedron& v = mesh.tetrahedra[t];
            if (const auto at = find(turned({v[i], v[j], v[k]})); at != faces.end())
                found[at->second].front.push_back({t, side + 1});
            if (const auto at = find(turned({v[k], v[j], v[i]})); at != faces.end())
                found[at->second].back.push_back({t, side + 1});
        }
    return found;
}

void append_side(std::string& out, const std::string& name, const std::vector<Side>& sides) {
    if (sides.empty()) return;
    out += fmt::format("*SURFACE, TYPE=ELEMENT, NAME={}\n", name);
    for (const Side& s : sides) out += fmt::format("{}, S{}\n", s.tetrahedron + 1, s.number);
}

/// Node set and surfaces of each surface.
std::string surface_lines(const TetrahedralMesh& mesh) {
    const auto names = label_names(mesh.surfaces);
    const auto sides = sides_of_faces(mesh);
    std::vector<std::vector<std::uint32_t>> nodes(names.size());
    std::vector<SidesOfFace> of_surface(names.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (const auto s : mesh.surfaces_of[f]) {
            nodes[s].insert(nodes[s].end(), mesh.faces[f].begin(), mesh.faces[f].end());
            auto& [front, back] = of_surface[s];
            front.insert(front.end(), sides[f].front.begin(), sides[f].front.end());
            back.insert(back.end(), sides[f].back.begin(), sides[f].back.end());
        }
    std::string out;
    for (std::size_t s = 0; s < names.size(); ++s) {
        if (nodes[s].empty()) continue;
        sort_unique(nodes[s]);
        out += fmt::format("*NSET, NSET={}\n", names[s]);
        append_set(out, nodes[s]);
        append_side(out, names[s] + "_FRONT", of_surface[s].front);
        append_side(out, names[s] + "_BACK", of_surface[s].back);
    }
    return out;
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

std::string to_abaqus(const TetrahedralMesh& mesh) {
    std::map<std::uint32_t, std::vector<std::size_t>> of_region;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
        of_region[mesh.region_of[t]].push_back(t);
    auto out = node_lines(mesh.vertices);
    for (const auto& [region, tetrahedra] : of_region) {
        auto name = region_name(region);
        std::replace(name.begin(), name.end(), ' ', '_');
        out += fmt::format("*ELEMENT, TYPE=C3D4, ELSET={}\n", name);
        for (const std::size_t t : tetrahedra) append_element(out, t, mesh.tetrahedra[t]);
    }
    return out + surface_lines(mesh);
}

} // namespace terrane
