// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/distribution/grid.hpp>

#include <bit>
#include <cmath>

namespace terrane::distribution {

Grid grid_over(const Box& box, std::size_t blocks) {
    // Surfaces fill about 4^bits cells. Some hundred cells per block balance within a few per cent.
    constexpr unsigned most_bits = 12;
    Grid grid;
    grid.bits = std::min(most_bits, 4 + static_cast<unsigned>(std::bit_width(blocks)) / 2);
    if (blocks == 1) grid.bits = 0;
    const double cells = static_cast<double>(std::uint32_t{1} << grid.bits);
    for (unsigned k = 0; k < 3; ++k) {
        grid.low[k] = box.low[k];
        const double half = box.high[k] / 2 - box.low[k] / 2;
        const double scale = cells / half;
        grid.scale[k] = half > 0 && std::isfinite(scale) ? scale : 0;
    }
    return grid;
}

std::vector<std::uint64_t> equal_runs(std::vector<CellWeight> cells, std::size_t blocks) {
    std::sort(cells.begin(), cells.end(),
              [](const CellWeight& a, const CellWeight& b) { return a.place < b.place; });
    std::uint64_t total = 0;
    for (const CellWeight& c : cells) total += c.weight;
    std::vector<std::uint64_t> splitters;
    std::uint64_t before = 0;
    std::size_t k = 0;
    for (std::size_t b = 1; b < blocks; ++b) {
        const auto goal = static_cast<std::uint64_t>(static_cast<double>(total) *
                                                     static_cast<double>(b) /
                                                     static_cast<double>(blocks));
        // A cell goes to the side where more than half of it belongs.
        while (k < cells.size() && before + (cells[k].weight + 1) / 2 <= goal)
            before += cells[k++].weight;
        while (k > 0 && k < cells.size() && cells[k].place == cells[k - 1].place)
            before += cells[k++].weight;
        splitters.push_back(k < cells.size() ? cells[k].place : UINT64_MAX);
    }
    return splitters;
}

std::vector<std::uint32_t> blocks_of(const Grid& grid, std::span<const std::uint64_t> splitters,
                                     const Box& box) {
    std::array<std::uint32_t, 3> low{}, high{};
    for (unsigned k = 0; k < 3; ++k) {
        low[k] = grid.cell(k, box.low[k]);
        high[k] = grid.cell(k, box.high[k]);
    }
    std::vector<std::uint32_t> blocks;
    std::array<std::uint32_t, 3> c{};
    for (c[0] = low[0]; c[0] <= high[0]; ++c[0])
        for (c[1] = low[1]; c[1] <= high[1]; ++c[1])
            for (c[2] = low[2]; c[2] <= high[2]; ++c[2]) {
                const auto b = block_at(splitters, grid.place(c));
                if (std::find(blocks.begin(), blocks.end(), b) == blocks.end())
                    blocks.push_back(b);
            }
    std::sort(blocks.begin(), blocks.end());
    return blocks;
}

} // namespace terrane::distribution
