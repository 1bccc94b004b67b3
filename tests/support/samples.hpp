// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace test_support {

using terrane::ErrorCode;
using terrane::Mesh;
using terrane::Point3;
using terrane::Result;
using terrane::Role;
using terrane::Surface;
using terrane::TetrahedralMesh;
using terrane::Triangle;

/// Returns three surfaces with awkward names and numbers; triangle 1 belongs to the first two, and
/// no triangle uses vertex 3.
inline Mesh awkward_mesh() {
    Mesh mesh;
    mesh.surfaces = {{"top reservoir", Role::horizon},
                     {"main \"A\" fault", Role::fault},
                     {"top reservoir", Role::unknown}};
    mesh.vertices = {{0.1, -0.0, 5e-324},
                     {4234567.123456789, 603006.757227, -2238.04224665696},
                     {3.4e38, -1e300, 1.7976931348623157e308},
                     {9, 9, 9},
                     {-2.2250738585072014e-308, 1.0 / 3, 123456789012345680},
                     {1, 2, 3}};
    mesh.triangles = {{0, 1, 2}, {1, 4, 2}, {5, 4, 0}, {0, 0, 5}};
    const std::vector<std::vector<std::uint32_t>> surfaces{{0}, {0, 1}, {1}, {2}};
    const std::vector<std::vector<std::uint32_t>> regions{{0}, {1, 2}, {2}, {3}};
    const std::vector<std::vector<std::uint32_t>> parents{{7}, {8, 9}, {10}, {11}};
    for (const auto& list : surfaces) mesh.surfaces_of.push_back(list);
    for (const auto& list : regions) mesh.regions_of.push_back(list);
    for (const auto& list : parents) mesh.parents_of.push_back(list);
    mesh.intersection_edges = {{1, 2}};
    return mesh;
}

/// Returns the awkward mesh with numbers that float32 represents exactly.
inline Mesh float_mesh() {
    auto mesh = awkward_mesh();
    mesh.vertices = {{0.5, -0.0, 1e-45f}, {4234567, 0.1f, -2238.25}, {3.4e38f, -1, 7},
                     {9, 9, 9},           {-8, 1.0f / 3, 6},         {1, 2, 3}};
    return mesh;
}

/// Returns two tetrahedra of blocks 0 and 2, the face between them, which belongs to two surfaces,
/// and a face on the box.
inline TetrahedralMesh two_tetrahedra() {
    TetrahedralMesh mesh;
    mesh.surfaces = {
        {"fault & <co>", Role::fault}, {"base", Role::horizon}, {"box", Role::boundary}};
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.1, -1}, {0, 0, 1}};
    mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    mesh.block_of = {0, 2};
    mesh.faces = {{0, 1, 2}, {0, 1, 3}};
    mesh.face_triangle = {5, UINT32_MAX};
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0, 1});
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{2});
    mesh.block_count = 3;
    return mesh;
}

/// Returns two tetrahedra with a cut between them, except at vertex 0: nodes 5 and 6 are behind it,
/// with face 2.
inline TetrahedralMesh cut_tetrahedra() {
    auto mesh = two_tetrahedra();
    mesh.vertices.push_back(mesh.vertices[1]);
    mesh.vertices.push_back(mesh.vertices[2]);
    mesh.tetrahedra = {{0, 1, 2, 3}, {0, 6, 5, 4}};
    mesh.faces.push_back({0, 5, 6});
    mesh.face_triangle.push_back(5);
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0, 1});
    mesh.twins = {{0, 2}};
    return mesh;
}

/// Splits a mesh into its surfaces, each with the vertices that it uses.
inline std::vector<Surface> split(const Mesh& mesh) {
    std::vector<Surface> result;
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
        auto& surface = result.emplace_back();
        surface.name = mesh.surfaces[s].name;
        surface.role = mesh.surfaces[s].role;
        std::vector<bool> used(mesh.vertices.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (const auto owner : mesh.surfaces_of[t])
                if (owner == s) {
                    surface.triangles.push_back(mesh.triangles[t]);
                    for (const auto v : mesh.triangles[t]) used[v] = true;
                }
        std::vector<std::uint32_t> number(mesh.vertices.size());
        for (std::size_t v = 0; v < used.size(); ++v) {
            if (!used[v]) continue;
            number[v] = static_cast<std::uint32_t>(surface.vertices.size());
            surface.vertices.push_back(mesh.vertices[v]);
        }
        for (auto& triangle : surface.triangles)
            for (auto& v : triangle) v = number[v];
    }
    return result;
}

/// Tells whether two points are equal to the last bit: -0 is not 0.
inline bool same_bits(const Point3& a, const Point3& b) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

inline bool same_bits(const std::vector<Point3>& a, const std::vector<Point3>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!same_bits(a[i], b[i])) return false;
    return true;
}

/// Returns the message of an error, or "no error".
template <class T>
std::string message_of(const Result<T>& result) {
    return result ? "no error" : result.error().message();
}

/// Returns the code of a failure.
inline ErrorCode code_of(const terrane::Status& status) {
    return status ? ErrorCode::internal : status.error().code;
}

/// An invalid input and its expected error.
struct Broken {
    std::string_view text;
    ErrorCode code;
    std::string_view message;
};

} // namespace test_support
