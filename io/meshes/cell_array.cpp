// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/cell_array.hpp>

#include <utility>

namespace terrane {

std::vector<CellArray> volume_cells(std::span<const std::array<std::uint32_t, 2>> of_sides) {
    std::vector<CellArray> cells;
    for (const std::size_t side : {0, 1}) {
        std::vector<std::int32_t> values;
        for (const auto& sides : of_sides) values.push_back(static_cast<std::int32_t>(sides[side]));
        cells.push_back({side == 0 ? "volume_front" : "volume_back", std::move(values)});
    }
    return cells;
}

} // namespace terrane
