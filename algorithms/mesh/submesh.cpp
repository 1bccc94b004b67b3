// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/submesh.hpp>

#include <algorithm>
#include <array>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/invariants.hpp>

namespace terrane {
namespace {

Surface empty_surface(const SurfaceInfo& info) {
    return {info.name, info.role, {}, {}};
}

} // namespace

VertexRenumbering::VertexRenumbering(const std::vector<bool>& used) : new_of_(used.size(), unused) {
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) new_of_[v] = kept_++;
}

std::vector<Point3> Submesh::cut_small(std::vector<Triangle>& triangles) const {
    std::vector<std::uint32_t> used;
    for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
    sort_unique(used);
    std::vector<Point3> part;
    part.reserve(used.size());
    for (const std::uint32_t v : used) part.push_back(whole_[v]);
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t)
            v = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) -
                                           used.begin());
    return part;
}

std::vector<Point3> Submesh::cut(std::vector<Triangle>& triangles) {
    TERRANE_ASSERT_PARANOID(corners_below(triangles, whole_.size()));
    if (triangles.size() < whole_.size() / 48) return cut_small(triangles);
    constexpr std::uint32_t unused = UINT32_MAX;
    in_part_.assign(whole_.size(), unused);
    for (const Triangle& t : triangles)
        for (const std::uint32_t v : t) in_part_[v] = 0;
    std::vector<Point3> part;
    for (std::size_t v = 0; v < whole_.size(); ++v) {
        if (in_part_[v] == unused) continue;
        in_part_[v] = static_cast<std::uint32_t>(part.size());
        part.push_back(whole_[v]);
    }
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t) v = in_part_[v];
    return part;
}

Surface surface_of_mesh(const Mesh& mesh, std::uint32_t surface) {
    Surface out = empty_surface(mesh.surfaces[surface]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto list = mesh.surfaces_of[t];
        if (std::binary_search(list.begin(), list.end(), surface))
            out.triangles.push_back(mesh.triangles[t]);
    }
    out.vertices = Submesh(mesh.vertices).cut(out.triangles);
    return out;
}

std::vector<Surface> surfaces_of_mesh(const Mesh& mesh) {
    std::vector<Surface> all;
    all.reserve(mesh.surfaces.size());
    for (const SurfaceInfo& info : mesh.surfaces) all.push_back(empty_surface(info));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t])
            all[s].triangles.push_back(mesh.triangles[t]);
    Submesh parts(mesh.vertices);
    for (Surface& s : all) s.vertices = parts.cut(s.triangles);
    return all;
}

Mesh concatenate(std::span<const Surface> surfaces) {
    Mesh mesh;
    for (const Surface& s : surfaces) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const auto number = static_cast<std::uint32_t>(mesh.surfaces.size());
        mesh.surfaces.push_back({s.name, s.role});
        mesh.vertices.insert(mesh.vertices.end(), s.vertices.begin(), s.vertices.end());
        for (const Triangle& t : s.triangles) {
            mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
            mesh.surfaces_of.push_back(std::array{number});
        }
    }
    return mesh;
}

} // namespace terrane
