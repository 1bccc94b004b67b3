// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace terrane {

/// A named array with one value per cell, for the formats that have such arrays (VTP, VTU).
struct CellArray {
    std::string name; ///< "volume", "quality", ...
    std::variant<std::vector<std::int32_t>, std::vector<double>> values; ///< one per cell
};

} // namespace terrane
