// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Small meshes for TetGen, and calls that must succeed or fail.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/kernel/predicates.hpp>

namespace tetgen_cases {

using namespace terrane;

inline const Box3 unit_box{{-1, -1, -1}, {2, 2, 2}};

/// Builds a mesh surface by surface; equal points become one vertex.
class MeshBuilder {
public:
    std::uint32_t surface(const std::string& name) {
        mesh_.surfaces.push_back({name, Role::unknown});
        return static_cast<std::uint32_t>(mesh_.surfaces.size() - 1);
    }
    void triangle(std::uint32_t surface, const Point3& a, const Point3& b, const Point3& c) {
        mesh_.triangles.push_back({vertex(a), vertex(b), vertex(c)});
        mesh_.surfaces_of.push_back(std::array{surface});
    }
    void quad(std::uint32_t surface, const Point3& a, const Point3& b, const Point3& c,
              const Point3& d) {
        triangle(surface, a, b, c);
        triangle(surface, a, c, d);
    }
    /// Adds the six sides of a box, oriented outward.
    void block(std::uint32_t s, const Point3& l, const Point3& h) {
        quad(s, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z});
        quad(s, {l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
        walls(s, l, h);
    }
    void walls(std::uint32_t s, const Point3& l, const Point3& h) {
        quad(s, {l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
        quad(s, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z});
        quad(s, {h.x, h.y, l.z}, {l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z});
        quad(s, {l.x, h.y, l.z}, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z});
    }
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }

private:
    std::uint32_t vertex(const Point3& p) {
        const auto [at, added] = index_.try_emplace(p, mesh_.vertices.size());
        if (added) mesh_.vertices.push_back(p);
        return at->second;
    }
    Mesh mesh_;
    std::map<Point3, std::uint32_t> index_;
};

inline Mesh cube() {
    MeshBuilder builder;
    builder.block(builder.surface("cube"), {0, 0, 0}, {1, 1, 1});
    return builder.mesh();
}

inline Mesh rectangle() {
    MeshBuilder builder;
    builder.quad(builder.surface("sheet"), {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    return builder.mesh();
}

/// Returns a sheet of n x n squares with uneven heights.
inline Mesh uneven_sheet(unsigned n) {
    MeshBuilder builder;
    const std::uint32_t surface = builder.surface("horizon");
    const auto at = [&](unsigned i, unsigned j) {
        const unsigned height = (i * 7 + j * 13 + i * j * 5) % 11;
        return Point3{double(i) / n, double(j) / n, height / 64.0};
    };
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
            builder.quad(surface, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return builder.mesh();
}

inline TetrahedralMesh must(const Mesh& mesh, const TetrahedraOptions& options) {
    Result<TetrahedralMesh> result = tetrahedralize(mesh, options, Run{});
    INFO((result ? std::string() : result.error().message()));
    REQUIRE(result.ok());
    const TetrahedralMesh& made = result.value();
    CHECK(made.block_of.size() == made.tetrahedra.size());
    CHECK(made.face_triangle.size() == made.faces.size());
    CHECK(made.surfaces_of.size() == made.faces.size());
    CHECK(made.surfaces.size() == mesh.surfaces.size() + 1);
    CHECK(made.surfaces.back().name == "box");
    for (const auto& [a, b, c, d] : made.tetrahedra) {
        const auto& v = made.vertices;
        REQUIRE(orient3d(v[a], v[b], v[c], v[d]) == Sign::Positive);
    }
    return std::move(result).value();
}

inline Error must_fail(const Mesh& mesh, const TetrahedraOptions& options, const Run& run = {}) {
    const Result<TetrahedralMesh> result = tetrahedralize(mesh, options, run);
    REQUIRE(!result.ok());
    CHECK(!result.error().sentence.empty());
    return result.error();
}

} // namespace tetgen_cases
