// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The mesh while it is being improved: the triangles of all sheets together, with the star of each
// vertex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>

namespace terrane::quality::detail {

/// Replaces some triangles by others with the same border. One vertex may move or be new.
struct Change {
    std::vector<std::uint32_t> removed; ///< triangles, each once
    std::vector<Triangle> added;        ///< their vertices
    std::vector<std::uint32_t> from;    ///< per added triangle: the removed one whose sheet it
                                        ///< takes
    std::vector<std::pair<std::uint32_t, Point3>>
        facing;                  ///< per sheet of removed triangles: the sum of their normals
    bool in_place = false;       ///< only a vertex moves; added triangles have the same vertices
    bool on_border = false;      ///< a curve changes
    std::uint32_t placed = none; ///< in place: the vertex that moves; else the new vertex, which is
                                 ///< the next free index
    Point3 place{};              ///< new position of `placed`
    VertexKind kind{};           ///< of a new vertex
    double size = 0;             ///< of a new vertex: target length of its edges

    void clear() {
        removed.clear();
        added.clear();
        from.clear();
        facing.clear();
        in_place = on_border = false;
        placed = none;
    }
    /// Gives the new vertex its final index.
    void number_new(std::uint32_t v) {
        if (in_place || placed == none || placed == v) return;
        for (Triangle& t : added)
            for (std::uint32_t& c : t)
                if (c == placed) c = v;
        placed = v;
    }
    /// Returns the position of a vertex after the change.
    [[nodiscard]] const Point3& point(std::span<const Point3> before, std::uint32_t v) const {
        return v == placed ? place : before[v];
    }
    void add(const Triangle& corners, std::uint32_t source) {
        added.push_back(corners);
        from.push_back(source);
    }
};

class WorkMesh {
public:
    WorkMesh(const Mesh& mesh, const Features& features);

    std::vector<Point3> points;
    std::vector<double> sizes;           ///< per vertex: target length of its edges
    std::vector<VertexKind> kinds;       ///< per vertex
    std::vector<std::uint32_t> curve_of; ///< per vertex of kind curve; else none
    std::vector<double> place_on;        ///< per vertex of kind curve: its arc length
    std::vector<std::array<std::uint32_t, 2>>
        along; ///< per vertex of kind curve: the vertices before and after it

    std::vector<Triangle> triangles;     ///< unused ones have [0] == none
    std::vector<std::uint32_t> sheet_of; ///< per triangle
    std::vector<std::uint32_t> hint_of;  ///< per triangle: an input triangle near it, in its sheet
    std::vector<char> isolated;          ///< per triangle: it follows isolated input triangles only
                                         ///< (ReferenceSurface)
    std::vector<std::uint32_t> changed_at; ///< per triangle: when it or its shape changed last
    std::uint32_t now = 1;                 ///< counts sweeps over the mesh
    /// Six triangles at most vertices; ten fit without allocation, in 64 bytes.
    using Star = boost::container::small_vector<std::uint32_t, 10>;
    std::vector<Star> star; ///< per vertex: its triangles, in any order

    [[nodiscard]] bool in_use(std::uint32_t t) const { return triangles[t][0] != none; }

    /// Returns the curve that contains the edge (a, b), or none.
    [[nodiscard]] std::uint32_t curve_at(std::uint32_t a, std::uint32_t b) const;
    /// Returns the arc length of the vertex v of an edge on a curve; `other` is the other end of
    /// the edge.
    [[nodiscard]] double place_at(const std::vector<Curve>& curves, std::uint32_t curve,
                                  std::uint32_t v, std::uint32_t other) const;
    /// Records that a curve now consists of the single edge (a, b), or no longer does.
    void set_direct(std::uint32_t a, std::uint32_t b, std::uint32_t curve);
    void drop_direct(std::uint32_t a, std::uint32_t b);
    /// Returns all curves that consist of one edge.
    [[nodiscard]] const std::unordered_map<std::uint64_t, std::uint32_t>& direct() const {
        return direct_;
    }

    /// Finds the triangles at the edge (a, b).
    void triangles_at(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& found) const;
    [[nodiscard]] bool are_neighbours(std::uint32_t a, std::uint32_t b) const;
    /// Finds the vertices that share an edge with v, each once, ascending.
    void neighbours(std::uint32_t v, std::vector<std::uint32_t>& found) const;

    /// Carries the change out and lists the indices of the added triangles in `numbers`.
    void apply(const Change& change, std::span<const std::uint32_t> hints,
               std::vector<std::uint32_t>& numbers);

    /// Tells whether a triangle at v has changed at `time` or later.
    [[nodiscard]] bool changed_since(std::uint32_t v, std::uint32_t time) const {
        for (const std::uint32_t t : star[v])
            if (changed_at[t] >= time) return true;
        return false;
    }

    /// Removes unused triangles and renumbers the others.
    void compact();

    [[nodiscard]] Point3 normal(const Triangle& t) const {
        return cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
    }
    [[nodiscard]] std::uint32_t next_vertex() const {
        return static_cast<std::uint32_t>(points.size());
    }
    [[nodiscard]] double edge_length(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] double wanted_length(std::uint32_t a, std::uint32_t b) const {
        return (sizes[a] + sizes[b]) / 2;
    }

private:
    static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
        return a < b ? std::uint64_t{a} << 32U | b : std::uint64_t{b} << 32U | a;
    }
    void add_vertex(const Point3& p, VertexKind kind, double size);
    void take_from_star(std::uint32_t v, std::uint32_t t);

    std::unordered_map<std::uint64_t, std::uint32_t> direct_; ///< edges from corner to corner
};

/// Returns the corner of a triangle that is neither a nor b.
inline std::uint32_t opposite(const Triangle& t, std::uint32_t a, std::uint32_t b) {
    return t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
}

inline bool has(const Triangle& t, std::uint32_t v) {
    return t[0] == v || t[1] == v || t[2] == v;
}

inline Triangle with(Triangle t, std::uint32_t old, std::uint32_t v) {
    for (std::uint32_t& c : t)
        if (c == old) c = v;
    return t;
}

} // namespace terrane::quality::detail
