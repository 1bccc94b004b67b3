// SPDX-License-Identifier: LGPL-3.0-or-later
//
// An oriented patch of triangles from which vertices can be removed and whose edges can be swapped.
// Qualities and normals are in floating point. The topology never changes: no edge ever gets a
// third triangle, and the number of holes and handles stays the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Returns the shape of a triangle with respect to a direction: 4 sqrt(3) area / (sum of squared
/// edges), which is 1 for equilateral and 0 for degenerate triangles; negative if the triangle
/// faces away.
double shape(const Point3& a, const Point3& b, const Point3& c, const Point3& direction);

class DiskMesh {
public:
    /// Triangles must be oriented consistently, each edge with at most two of them. No operation
    /// creates an edge of `taken` (sorted), as those belong to other meshes.
    DiskMesh(std::vector<Point3> points, std::vector<Triangle> triangles,
             std::vector<Edge> taken = {});

    [[nodiscard]] const std::vector<Point3>& points() const { return points_; }
    void move(std::uint32_t vertex, const Point3& to) { points_[vertex] = to; }

    /// Returns the current triangles, in order of creation.
    [[nodiscard]] std::vector<Triangle> triangles() const;
    /// Returns the vertices that share an edge with v, ascending.
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const;
    [[nodiscard]] bool is_alive(std::uint32_t v) const { return !star_[v].empty(); }

    /// Tells whether v has an edge with one triangle.
    [[nodiscard]] bool is_at_border(std::uint32_t v) const;
    /// Moves v, unless that would flip a triangle with respect to the former normal, or make the
    /// worst shape both worse than before and less than `sound`.
    bool move_if_sound(std::uint32_t v, const Point3& to, double sound);

    /// Removes v and retriangulates its star so that the worst shape is as good as possible. A
    /// border vertex leaves a straight border edge. Returns false and changes nothing if a triangle
    /// would be flipped or an edge would get a third triangle.
    bool remove(std::uint32_t v);

    /// Swaps inner edges at `vertices` while that improves the worse of the two triangles and flips
    /// neither. Returns the number of swaps.
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
    std::vector<Triangle> triangles_;              ///< also removed ones
    std::vector<bool> alive_;                      ///< per triangle
    std::vector<std::vector<std::uint32_t>> star_; ///< per vertex: its current triangles, ascending
};

} // namespace terrane
