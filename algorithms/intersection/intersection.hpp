// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Performs step (c) of the arrangement: determines exactly how two triangles meet. The answer is
// combinatorial: it states which open simplex of one triangle meets which of the other and how each
// common point is constructed. Coordinates are computed later. Source: a complete version of the
// paper's triangle-triangle test, with orientation tests as in Devillers and Guigue (2002).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// The open simplex of a closed triangle on which a point lies: corner i, the open edge i (from
/// corner i to i + 1), or the open face.
enum class Simplex : std::uint8_t { corner0, corner1, corner2, edge0, edge1, edge2, face };

constexpr bool is_corner(Simplex p) {
    return p <= Simplex::corner2;
}
constexpr bool is_edge(Simplex p) {
    return p >= Simplex::edge0 && p <= Simplex::edge2;
}
constexpr unsigned corner_of(Simplex p) {
    return static_cast<unsigned>(p);
}
constexpr unsigned edge_of(Simplex p) {
    return static_cast<unsigned>(p) - 3;
}
/// Whether p is edge e or one of its two ends, corner e and corner e + 1.
constexpr bool on_closed_edge(Simplex p, unsigned e) {
    if (is_edge(p)) return edge_of(p) == e;
    return is_corner(p) && (corner_of(p) == e || corner_of(p) == (e + 1) % 3);
}

/// A point that two triangles share.
struct ContactPoint {
    Construction how;               ///< of kind input if it is a vertex of one of them
    std::array<Simplex, 2> place{}; ///< on the first and on the second triangle
};

/// A point or a segment that two triangles share.
struct ContactPiece {
    std::array<std::uint8_t, 2> ends{}; ///< indices into points; equal for a point
    /// The line that carries it in the plane of triangle k: the plane of the other triangle (3) or,
    /// if the two are coplanar, edge 0..2 of the other triangle.
    std::uint8_t support = 3;
};

/// The intersection of two triangles, common vertices included: points and the segments between
/// them.
struct Contact {
    bool coplanar = false;
    bool overlap = false; ///< coplanar, and the common part has an area
    std::uint8_t point_count = 0;
    std::array<std::uint8_t, 2> piece_count{}; ///< pieces to draw in triangle 0 and in triangle 1
    std::array<ContactPoint, 9> points{};      ///< pairwise distinct constructions
    std::array<std::array<ContactPiece, 3>, 2> pieces{}; ///< not coplanar: one, the same for both;
                                                         ///< coplanar: per edge of the other
                                                         ///< triangle that meets this one
};

/// The filters tried before exact tests. They never change the result; `none` is for pairs that
/// have been filtered already.
enum class Filters { all, none };

/// Returns the contact of two triangles if they share more than the convex hull of their common
/// vertices, else std::nullopt. Equal vertex indices denote equal points, and different indices
/// different points. Each triangle must have an area, and the two must not have all three vertices
/// in common. Cost: no heap allocation; most pairs take one to six orient3d.
std::optional<Contact> improper_contact(std::span<const Point3> points, const Triangle& first,
                                        const Triangle& second, Filters filters = Filters::all);

// The following functions return constructions in canonical form (see Construction). Lines and
// planes are given by vertex indices.
Construction line_plane(std::array<std::uint32_t, 2> line, Triangle plane);
Construction three_planes(Triangle first, Triangle second, Triangle third);
Construction line_line(std::span<const Point3> points, std::array<std::uint32_t, 2> first,
                       std::array<std::uint32_t, 2> second);

} // namespace terrane
