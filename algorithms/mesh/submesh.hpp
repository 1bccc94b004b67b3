// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Parts of a mesh with the vertices that they use, and meshes of several surfaces. Vertices in use
// keep their order wherever they are numbered anew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/assertion.hpp>

namespace terrane {

/// Marks the vertices that cells (triangles, tetrahedra) use. Per vertex of [0, count).
template <class Cells>
std::vector<bool> used_vertices(std::size_t count, const Cells& cells) {
    std::vector<bool> used(count);
    for (const auto& cell : cells)
        for (const std::uint32_t v : cell) used[v] = true;
    return used;
}

/// New numbers for the vertices in use, in their order.
class VertexRenumbering {
public:
    explicit VertexRenumbering(const std::vector<bool>& used);

    [[nodiscard]] std::size_t kept() const { return kept_; }
    /// Keeps the values of vertices in use; `values` has one for each old vertex.
    template <class T>
    void compact(std::vector<T>& values) const {
        TERRANE_ASSERT(values.size() == new_of_.size());
        for (std::size_t v = 0; v < values.size(); ++v)
            if (new_of_[v] != unused) values[new_of_[v]] = values[v];
        values.resize(kept_);
    }
    /// Replaces old numbers by new ones in cells whose vertices are all in use.
    template <class Cells>
    void rename(Cells& cells) const {
        for (auto& cell : cells)
            for (std::uint32_t& v : cell) {
                TERRANE_ASSERT_DEBUG(v < new_of_.size() && new_of_[v] != unused);
                v = new_of_[v];
            }
    }

private:
    static constexpr std::uint32_t unused = UINT32_MAX;

    std::vector<std::uint32_t> new_of_; ///< per old vertex: new number, or unused
    std::uint32_t kept_ = 0;
};

/// Cuts parts out of one array of vertices.
class Submesh {
public:
    explicit Submesh(std::span<const Point3> vertices) : whole_(vertices) {}

    /// Renumbers `triangles` (indices of the whole, in range) and returns the vertices that they
    /// use. Cost: O(t log t) where the part is small, O(vertices of the whole) where it is not.
    std::vector<Point3> cut(std::vector<Triangle>& triangles);

private:
    std::vector<Point3> cut_small(std::vector<Triangle>& triangles) const;

    std::span<const Point3> whole_;
    std::vector<std::uint32_t> in_part_; ///< per vertex of the whole: its number in a large part
};

/// Extracts one surface of a mesh.
Surface surface_of_mesh(const Mesh& mesh, std::uint32_t surface);

/// Extracts all surfaces of a mesh, in its order. A triangle of several surfaces is in each.
std::vector<Surface> surfaces_of_mesh(const Mesh& mesh);

/// Makes one mesh of surfaces as they are: nothing is merged, each triangle has its one surface.
Mesh concatenate(std::span<const Surface> surfaces);

} // namespace terrane
