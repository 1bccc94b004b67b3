// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/scene.hpp>

#include <map>
#include <utility>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>

namespace terrane::page {
namespace {

double area_of(const std::vector<Point3>& vertices, const Triangle& t) {
    return area_between(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
}

double length_of(const std::vector<Point3>& vertices, const Edge& e) {
    return distance_between(vertices[e[0]], vertices[e[1]]);
}

/// Adds one line that consists of all these edges, unless there are none.
void add_line(Scene& scene, std::string kind, std::vector<std::uint32_t> surfaces,
              const std::vector<Edge>& edges) {
    if (edges.empty()) return;
    SceneLine line{std::move(kind), std::move(surfaces), 0, scene.segments.size(), edges.size()};
    for (const Edge& e : edges) line.length += length_of(scene.vertices, e);
    scene.segments.insert(scene.segments.end(), edges.begin(), edges.end());
    scene.lines.push_back(std::move(line));
}

/// Returns the edges of one triangle. Triangles that name a vertex twice are ignored.
std::vector<Edge> free_edges(const Mesh& mesh) {
    std::vector<Triangle> sound;
    sound.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) sound.push_back(t);
    std::vector<Edge> edges;
    group_edges(sound, mesh.vertices.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, const auto& sides) {
            if (sides.size() == 1) edges.push_back({low, high});
        });
    return edges;
}

/// Fills the triangles of the scene: those of each part, in the order of the parts.
void add_triangles(Scene& scene, const Mesh& mesh, const std::vector<std::uint32_t>& part_of) {
    std::size_t total = 0;
    for (const std::uint32_t p : part_of) ++scene.parts[p].count;
    for (ScenePart& part : scene.parts) {
        part.first = total;
        total += part.count;
        part.count = 0;
    }
    scene.triangles.resize(total);
    for (std::size_t t = 0; t < part_of.size(); ++t) {
        ScenePart& part = scene.parts[part_of[t]];
        scene.triangles[part.first + part.count++] = mesh.triangles[t];
        part.area += area_of(mesh.vertices, mesh.triangles[t]);
    }
    scene.given = total;
}

} // namespace

Scene scene_of(const Mesh& mesh) {
    Scene scene;
    scene.vertices = mesh.vertices;
    std::map<std::vector<std::uint32_t>, std::uint32_t> numbers;
    std::vector<std::uint32_t> part_of;
    part_of.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto of = mesh.surfaces_of[t];
        std::vector<std::uint32_t> surfaces(of.begin(), of.end());
        const auto next = static_cast<std::uint32_t>(scene.parts.size());
        const auto [found, is_new] = numbers.try_emplace(surfaces, next);
        if (is_new) {
            scene.parts.emplace_back();
            scene.parts.back().surfaces = std::move(surfaces);
        }
        part_of.push_back(found->second);
    }
    add_triangles(scene, mesh, part_of);
    add_line(scene, "intersection curve", {}, mesh.intersection_edges);
    add_line(scene, "free border", {}, free_edges(mesh));
    return scene;
}

Scene scene_of(const Model& model) {
    const Mesh& mesh = model.mesh;
    const Structure& structure = model.structure;
    Scene scene;
    scene.vertices = mesh.vertices;
    for (const ModelInterface& i : structure.interfaces) {
        scene.parts.emplace_back();
        scene.parts.back().surfaces = i.surfaces;
        scene.parts.back().blocks = i.volumes;
    }
    std::vector<std::uint32_t> part_of(structure.interface_of.begin(),
                                       structure.interface_of.end());
    add_triangles(scene, mesh, part_of);
    std::vector<std::size_t> next;
    for (const ScenePart& part : scene.parts) next.push_back(part.first);
    for (std::size_t t = 0; t < part_of.size(); ++t) { // the first block is in front of all
        Triangle& triangle = scene.triangles[next[part_of[t]]++];
        const auto& blocks = *scene.parts[part_of[t]].blocks;
        if (model.volumes.of_sides[t][0] != blocks[0]) std::swap(triangle[1], triangle[2]);
    }
    for (const ModelLine& line : structure.lines) {
        std::vector<Edge> edges;
        for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i)
            edges.push_back({line.vertices[i], line.vertices[i + 1]});
        add_line(scene, std::string(name_of(line.kind)), line.surfaces, edges);
    }
    return scene;
}

void add_tetrahedra(Scene& scene, const TetrahedralMesh& mesh, std::size_t most) {
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
        if (mesh.block_of[t] != 0) chosen.push_back(t);
    if (chosen.size() > most) {
        scene.left_out = chosen.size();
        return;
    }
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> number_of(mesh.vertices.size(), none);
    for (const std::uint32_t t : chosen) {
        auto corners = mesh.tetrahedra[t];
        for (std::uint32_t& v : corners) {
            if (number_of[v] == none) {
                number_of[v] = static_cast<std::uint32_t>(scene.nodes.size());
                scene.nodes.push_back(mesh.vertices[v]);
            }
            v = number_of[v];
        }
        scene.tetrahedra.push_back(corners);
        scene.block_of.push_back(mesh.block_of[t]);
    }
}

} // namespace terrane::page
