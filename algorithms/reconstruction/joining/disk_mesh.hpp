// SPDX-License-Identifier: LGPL-3.0-or-later
//
// An oriented patch of triangles that can give up vertices and change diagonals. Private to join.
// Qualities and normals are in floating point; topology stays that of the patch: no edge ever gets
// a third triangle, and what the operations make is a patch with the same holes and handles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Shape of a triangle with respect to a direction: 1 equilateral, 0 degenerate, negative where the
/// triangle faces away. 4 sqrt(3) area / (sum of squared edges).
double shape(const Point3& a, const Point3& b, const Point3& c, const Point3& direction);

class DiskMesh {
public:
    /// Triangles are consistently oriented; each edge has at most two. No operation makes an edge
    /// of `taken` (sorted): those are edges of other meshes.
    DiskMesh(std::vector<Point3> points, std::vector<Triangle> triangles,
             std::vector<Edge> taken = {});

    [[nodiscard]] const std::vector<Point3>& points() const { return points_; }
    void move(std::uint32_t vertex, const Point3& to) { points_[vertex] = to; }

    /// Living triangles, in the order in which they were made.
    [[nodiscard]] std::vector<Triangle> triangles() const;
    /// Vertices that share an edge with v, ascending.
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const;
    [[nodiscard]] bool is_alive(std::uint32_t v) const { return !star_[v].empty(); }

    /// Whether it has an edge with one triangle.
    [[nodiscard]] bool is_at_border(std::uint32_t v) const;
    /// Moves v unless a triangle at it would turn away from where those at it faced, or the worst
    /// shape there would get worse and be below `sound`.
    bool move_if_sound(std::uint32_t v, const Point3& to, double sound);

    /// Takes v out and fills its star with the triangles, among all triangulations, whose worst
    /// shape is best. A border vertex leaves a straight border edge. False, and nothing is changed,
    /// where a triangle would face away or an edge would get a third triangle.
    bool remove(std::uint32_t v);

    /// Swaps diagonals while the worse of the two triangles gets
    /// better and neither faces away, at inner edges of `vertices`. Returns how many were swapped.
    std::size_t improve(std::span<const std::uint32_t> vertices);

private:
    struct Link { ///< around a vertex, counterclockwise
        std::vector<std::uint32_t> vertices;
        bool closed = false;
    };
    [[nodiscard]] std::optional<Link> link_of(std::uint32_t v) const;
    [[nodiscard]] std::ptrdiff_t triangles_at(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] bool has_edge(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] Point3 normal_of(std::span<const std::uint32_t> triangles) const;
    [[nodiscard]] std::optional<std::vector<Triangle>> fill(std::uint32_t v,
                                                            const Link& link) const;
    void add(const Triangle& t);
    void erase(std::uint32_t triangle);
    bool swap(std::uint32_t a, std::uint32_t b);

    std::vector<Point3> points_;
    std::vector<Edge> taken_;
    std::vector<Triangle> triangles_;              ///< living and dead
    std::vector<bool> alive_;                      ///< per triangle
    std::vector<std::vector<std::uint32_t>> star_; ///< per vertex: living triangles, ascending
};

} // namespace terrane
