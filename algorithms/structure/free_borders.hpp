// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds where surfaces end without meeting another one: the leaks through which volumes are
// connected.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane {

/// A part of a free border whose nearest surface is the same and whose distances are of one order
/// of magnitude, so that borders that stop a little short are separated from those that end far
/// away.
struct BorderGap {
    SurfaceId surface{}; ///< the nearest surface that the border does not belong to
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
    SurfaceId to{};          ///< the surface nearest to it
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

} // namespace terrane
