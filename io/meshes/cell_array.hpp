// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Returns the arrays volume_front and volume_back. of_sides: per triangle, see Volumes.
std::vector<CellArray> volume_cells(std::span<const std::array<std::uint32_t, 2>> of_sides);

} // namespace terrane
