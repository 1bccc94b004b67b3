// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Changes of a few tetrahedra that would make them better.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/optimisation/detail/cells.hpp>

namespace terrane::optimisation::detail {

/// Cells and what would take their place.
struct Change {
    enum class Kind : std::uint8_t { edge, face, move, contraction, insertion, remeshing };
    Kind kind{};
    std::vector<std::uint32_t> old;
    std::vector<Corners> added; ///< corner `none` - i stands for the new vertex i; empty for a move
    std::uint32_t vertex = none; ///< that moves
    std::vector<Point3> places;  ///< of the vertex that moves, or of new ones
    double quality = 0; ///< least of the new cells, by more than the least gain above that of `old`
};

/// Makes a change, if the new cells are as good as demanded. Returns whether it did.
bool make(Cells& cells, Change& change, const Demand& demand);

// A change is proposed if the least quality of the new cells is above that of the old ones by
// `gain`, and above the least gain. The number of tetrahedra that were measured is added to `effort`.

/// Removes the edge between two corners of a cell. None if that is no gain, the edge is on a wall,
/// or too many cells are around it.
std::optional<Change> without_edge(const Cells& cells, std::uint32_t c, unsigned i, unsigned j,
                                   double gain, std::size_t& effort);

/// Removes faces at the edge between two corners of a cell, which is on walls, and divides the
/// space beyond them anew.
std::optional<Change> with_fewer_faces(const Cells& cells, std::uint32_t c, unsigned i, unsigned j,
                                       double gain, std::size_t& effort);

/// Removes the face opposite to corner k, and neighbouring faces between the same two vertices where
/// that is better.
std::optional<Change> without_face(const Cells& cells, std::uint32_t c, unsigned k, double gain,
                                   std::size_t& effort);

/// Moves a vertex, which must not be fixed, onto another one. `star`: the cells at it.
std::optional<Change> contracted(const Cells& cells, std::uint32_t gone,
                                 const std::vector<std::uint32_t>& star, std::uint32_t kept,
                                 double gain, std::size_t& effort);

/// Moves a vertex, which must not be fixed, to a better place. `star`: the cells at it.
std::optional<Change> moved(const Cells& cells, std::uint32_t v,
                            const std::vector<std::uint32_t>& star, std::size_t& effort);

/// Moves a vertex on walls to a better place where it may be. None if it is not free. `star`: as above.
std::optional<Change> loosened(const Cells& cells, std::uint32_t v,
                               const std::vector<std::uint32_t>& star, std::size_t& effort);

/// Insert a vertex near a cell, from several first places. The cavity around it grows through the
/// face that makes the worst new tetrahedron. With a positive gain there are no more bad ones then.
std::vector<Change> insertions(const Cells& cells, std::uint32_t c, double gain,
                               std::size_t& effort);

} // namespace terrane::optimisation::detail
