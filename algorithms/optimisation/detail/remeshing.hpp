// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divides the surroundings of a bad tetrahedron anew.
#pragma once

#include <cstdint>

#include <terrane/algorithms/optimisation/detail/cells.hpp>
#include <terrane/algorithms/optimisation/detail/proposals.hpp>

namespace terrane::optimisation::detail {

/// Tells whether a cell lies between two walls whose acute angle is its worst one: then nothing
/// makes it better.
bool is_between_walls(const Cells& cells, std::uint32_t c);

/// Looks for several changes near a cell that are a gain together, though the first of them alone
/// is not. In a copy of the cells around it, each possible first change is made and followed by
/// such that are a gain; the best result counts, if it is better than the cells that it replaces.
/// Only reads the cells.
Proposal remeshing_at(const Cells& cells, std::uint32_t c, const Permission& permission,
                      double wanted);

} // namespace terrane::optimisation::detail
