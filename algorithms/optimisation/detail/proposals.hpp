// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which change is best for a tetrahedron, or for a vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <terrane/algorithms/optimisation/detail/cells.hpp>
#include <terrane/algorithms/optimisation/detail/changes.hpp>

namespace terrane::optimisation::detail {

/// The changes that may be proposed.
struct Permission {
    bool may_grow = true;     ///< whether a new cell may be larger than all that it replaces
    double least_sine = 0;    ///< of the mesh: no new cell may have a smaller one
    double least_quality = 0; ///< that new cells must have
    double urgent = 0;        ///< where a cell is worse than that, more may be bad afterwards
};

/// Tells whether a cell that a change makes is larger than all that it replaces.
bool grows(const Cells& cells, const Change& change);

/// A change, and what it took to find it.
struct Proposal {
    std::optional<Change> change; ///< none was found
    std::size_t effort = 0;       ///< tetrahedra that were measured, or looked at around an edge
};

/// Which kinds of changes are looked for. Each takes about ten times as long as those before.
enum class Depth : std::uint8_t {
    flips,     ///< edges and faces go, and vertices join
    moves,     ///< or a corner moves
    insertions ///< or a vertex is inserted
};

/// Proposes the best change that makes a cell, or a neighbour, better: edges and faces go or
/// vertices join; if none of these is a gain, a corner moves; if none of these is, a vertex is
/// inserted. Only reads the cells.
Proposal change_for_cell(const Cells& cells, std::uint32_t c, const Permission& permission,
                         Depth depth = Depth::insertions);

/// Proposes a better place for a corner of a cell that is on walls and free. Only reads the cells.
Proposal loosening_at(const Cells& cells, std::uint32_t c, const Permission& permission);

/// Proposes a better place for a vertex that is not fixed. Only reads the cells.
Proposal change_for_vertex(const Cells& cells, std::uint32_t v, const Permission& permission);

} // namespace terrane::optimisation::detail
