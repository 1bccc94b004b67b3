// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How surfaces end and meet: the leaks where one ends without meeting another, and tables that
// structural geologists ask for: which surface stops against which, along what length and with what
// gap; and which blocks face each other across a fault.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane {

// Finds where surfaces end without meeting another one: the leaks through which volumes are
// connected.

/// A part of a free border whose nearest surface is the same and whose distances are of one order
/// of magnitude, so that borders that stop a little short are separated from those that end far
/// away.
struct BorderGap {
    SurfaceId surface{}; ///< the nearest one; of its own surface only other parts count
    int decade = 0;      ///< distances are in [10^decade, 10^(decade + 1)); INT_MIN: they are 0
    double length = 0;   ///< of this part of the border
    double least = 0;    ///< smallest distance of an edge, at its farther end
    double largest = 0;  ///< largest distance of an edge, at its farther end
    Point3 place{};      ///< the vertex or midpoint with the largest distance
};

/// A free border, from corner to corner or closed.
struct FreeBorder {
    std::uint32_t line = 0;                ///< of the structure, of kind free_border
    std::vector<std::uint32_t> surfaces{}; ///< that end here, ascending
    double length = 0;                     ///< unit of the mesh
    bool closed = false;                   ///< whether it is a loop without corner
    std::vector<BorderGap> gaps{}; ///< by decade, then surface; empty if there is no other surface
};

/// Two surfaces, one of which ends near the other without meeting it, at distances of one order of
/// magnitude.
struct Leak {
    SurfaceId from{};        ///< the surface that ends
    SurfaceId to{};          ///< the surface nearest to it; `from`: another part of it
    int decade = 0;          ///< as in BorderGap
    std::size_t borders = 0; ///< parts of borders
    double length = 0;       ///< of these parts
    double least = 0;        ///< smallest distance
    double largest = 0;      ///< largest distance
    Point3 place{};          ///< where it is largest

    /// Adds a part of a border of the surface `from`.
    void add(const BorderGap& gap);
};

/// Finds all free borders, in the order of their lines. Each edge counts for the surface nearest to
/// its farthest point. Distances and lengths are in the unit of the mesh, in floating point. Cost:
/// O(n log n) for a search tree; two queries in it per border vertex.
std::vector<FreeBorder> find_free_borders(const Mesh& mesh, const Structure& structure);

/// Summarises free borders by pairs of surfaces: by the surface that ends, then the other. A border
/// of several surfaces counts for each.
std::vector<Leak> leaks_of(std::span<const FreeBorder> borders);

/// The relation of two surfaces where they meet, or nearly meet.
enum class RelationKind : std::uint8_t {
    stops,    ///< `from` ends at `to`, which goes on
    crosses,  ///< both go on
    meets,    ///< both end
    overlaps, ///< both have the triangles at the line
    near,     ///< `from` ends near `to` without meeting it
};

/// Names the kind: "stops at", "crosses", "meets", "overlaps", "ends near".
std::string_view name_of(RelationKind kind);

/// One kind of contact between two surfaces. All but `stops` and `near` are symmetric, and listed
/// once, with from < to.
struct SurfaceRelation {
    SurfaceId from{};                       ///< the surface that ends
    SurfaceId to{};                         ///< the other one
    RelationKind kind = RelationKind::near; ///< the kind of relation
    double length = 0;                      ///< of all lines, unit of the mesh
    double least = 0;   ///< of `near`: the smallest gap, as in Leak; otherwise 0
    double largest = 0; ///< of `near`: the largest gap
    Point3 place{};     ///< on the longest line; of `near`: where the gap is largest
};

/// Two blocks that face each other across a surface.
struct Juxtaposition {
    SurfaceId surface{};                   ///< between them
    std::array<std::uint32_t, 2> blocks{}; ///< numbers, the lower first; 0 is the outside
    double area = 0;                       ///< squared unit
};

/// Finds how surfaces end at each other, by the lines of the structure and the gaps of free
/// borders: by `from`, `to`, kind. Gaps of different orders of magnitude are different relations,
/// the smallest first. Cost: linear in the triangles, n log n in the lines.
std::vector<SurfaceRelation> find_relations(const Mesh& mesh, const Structure& structure,
                                            std::span<const FreeBorder> borders);

/// Finds the areas across which blocks face each other, by surface, then blocks. Parts of a surface
/// that dangle in one block are left out; an area of several surfaces counts for each.
std::vector<Juxtaposition> find_juxtapositions(const Structure& structure);

} // namespace terrane
