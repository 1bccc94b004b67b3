// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which surfaces run along which triangles.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::tolerance::detail {

/// A surface that runs along a triangle.
struct Owner {
    std::uint32_t surface = 0;
    bool is_reversed = false; ///< whether its triangle has the other orientation

    friend bool operator==(const Owner&, const Owner&) = default;
};

/// Per triangle: its owners, by surface; none: the triangle goes.
using Owners = std::vector<std::vector<Owner>>;

/// Triangles that meet in shared vertices and edges only, and the input triangles that contain each.
struct Pieces {
    std::span<const Triangle> triangles;
    const IndexLists<std::uint32_t>& parents_of;
    std::span<const Point3> places; ///< of vertices
};

/// Finds the owners of pieces by those of other pieces of the same input triangles, `before`. Pieces with
/// the same parents have the same owners up to edges where others are. The widest one of these is
/// located; where all are too narrow for that, they are owned by what makes closed surfaces closed.
/// given[p]: the number among the parents before of parent p.
Owners owners_of(const Pieces& pieces, const Pieces& before, const Owners& owners_before,
                 const std::vector<bool>& closed,
                 const std::function<std::uint32_t(std::uint32_t)>& given, const Run& run);

/// Tells whether all closed surfaces have an even number of triangles at each edge.
bool are_closed(const Pieces& pieces, const Owners& owners, const std::vector<bool>& closed,
                const Run& run);

} // namespace terrane::tolerance::detail
