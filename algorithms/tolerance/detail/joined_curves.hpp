// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::tolerance::detail {

/// Joins borders and creases that are nearer than `bound`. Surface by surface, their vertices move to
/// the nearest vertex of earlier ones, or to the nearest place on their edges, which get a vertex
/// there; then they are divided where earlier vertices are near. Returns the number of vertices that
/// moved, each by less than `bound`, in space only: edges are then at most so far from where they were.
std::size_t join_curves(std::vector<Surface>& surfaces, double bound);

} // namespace terrane::tolerance::detail
