// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace terrane {

/// A named array with one value per cell, for the formats that have such arrays (VTP, VTU).
struct CellArray {
    std::string name; ///< "volume", "quality", ...
    std::variant<std::vector<std::int32_t>, std::vector<double>> values; ///< one per cell
};

/// Returns the arrays volume_front and volume_back. of_sides: per triangle, see Volumes.
std::vector<CellArray> volume_cells(std::span<const std::array<std::uint32_t, 2>> of_sides);

} // namespace terrane
