// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The mesh while it is being improved: triangles of all sheets together, and what is at each
// vertex. Private to improve.
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

namespace terrane::improving {

/// Some triangles for others, with the same border. One vertex may get another place, or be new.
struct Change {
    std::vector<std::uint32_t> removed; ///< triangles, each once
    std::vector<Triangle> added;        ///< their corners
    std::vector<std::uint32_t> from;    ///< per added: the removed one it takes its sheet from
    std::vector<std::pair<std::uint32_t, Point3>>
        facing;                  ///< per sheet that is removed from: the sum of its normals there
    bool in_place = false;       ///< the corners are the same: a vertex moves
    bool on_border = false;      ///< a curve is changed
    std::uint32_t placed = none; ///< in place: the vertex that moves; else one that is new: the
                                 ///< number after the last one's
    Point3 place{};              ///< where that is to be
    VertexKind kind{};           ///< of a new one
    double size = 0;             ///< of a new one: wanted length of edges there

    void clear() {
        removed.clear();
        added.clear();
        from.clear();
        facing.clear();
        in_place = on_border = false;
        placed = none;
    }
    /// A new vertex gets this number.
    void number_new(std::uint32_t v) {
        if (in_place || placed == none || placed == v) return;
        for (Triangle& t : added)
            for (std::uint32_t& c : t)
                if (c == placed) c = v;
        placed = v;
    }
    /// Of a vertex after the change.
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
    std::vector<double> sizes;           ///< per vertex: wanted length of edges there
    std::vector<VertexKind> kinds;       ///< per vertex
    std::vector<std::uint32_t> curve_of; ///< per vertex of kind curve; else none
    std::vector<double> place_on;        ///< per vertex of kind curve: length along it
    std::vector<std::array<std::uint32_t, 2>>
        along; ///< per vertex of kind curve: the vertices before and after it

    std::vector<Triangle> triangles;     ///< [0] is none: not in use
    std::vector<std::uint32_t> sheet_of; ///< per triangle
    std::vector<std::uint32_t> hint_of;  ///< per triangle: one of the input near it, in its sheet
    std::vector<char> isolated; ///< per triangle: all that it follows is (ReferenceSurface)
    std::vector<std::uint32_t> changed_at; ///< per triangle: when it or its place changed last
    std::uint32_t now = 1;                 ///< counts sweeps over the mesh
    /// Mostly six, at their vertex: 64 bytes.
    using Star = boost::container::small_vector<std::uint32_t, 10>;
    std::vector<Star> star; ///< per vertex: the triangles at it, in any order

    [[nodiscard]] bool in_use(std::uint32_t t) const { return triangles[t][0] != none; }

    /// The curve that has the edge (a, b); none for any other edge.
    [[nodiscard]] std::uint32_t curve_at(std::uint32_t a, std::uint32_t b) const;
    /// Where an end of an edge on a curve lies on it; `other` is the other end.
    [[nodiscard]] double place_at(const std::vector<Curve>& curves, std::uint32_t curve,
                                  std::uint32_t v, std::uint32_t other) const;
    /// A curve is left without inner vertices, or is no more.
    void set_direct(std::uint32_t a, std::uint32_t b, std::uint32_t curve);
    void drop_direct(std::uint32_t a, std::uint32_t b);
    /// All curves that consist of one edge.
    [[nodiscard]] const std::unordered_map<std::uint64_t, std::uint32_t>& direct() const {
        return direct_;
    }

    /// The triangles that have the edge.
    void triangles_at(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& found) const;
    [[nodiscard]] bool are_neighbours(std::uint32_t a, std::uint32_t b) const;
    /// The vertices that share an edge with v, each once, ascending.
    void neighbours(std::uint32_t v, std::vector<std::uint32_t>& found) const;

    /// Carries it out. The numbers of the added triangles are in `numbers` then.
    void apply(const Change& change, std::span<const std::uint32_t> hints,
               std::vector<std::uint32_t>& numbers);

    /// Whether a triangle at v has changed at this time or later.
    [[nodiscard]] bool changed_since(std::uint32_t v, std::uint32_t time) const {
        for (const std::uint32_t t : star[v])
            if (changed_at[t] >= time) return true;
        return false;
    }

    /// Numbers the triangles anew, without gaps.
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

/// The corner of a triangle that is neither a nor b.
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

} // namespace terrane::improving
