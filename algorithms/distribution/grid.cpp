// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/distribution/grid.hpp>

#include <bit>
#include <cmath>
#include <utility>

namespace terrane::distribution {

BlockGrid grid_over(const Box& box, std::size_t blocks) {
    // Surfaces fill about 4^bits cells. Some hundred cells per block balance within a few per cent.
    constexpr unsigned most_bits = 12;
    BlockGrid grid;
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

namespace {

struct WeightedCell {
    std::uint64_t place = 0;
    double weight = 0;
};

/// Estimates the work in each cell. Cells ascend.
std::vector<WeightedCell> weighted(std::vector<CellCount> cells) {
    constexpr double per_curve = 27;
    std::sort(cells.begin(), cells.end(), [](const CellCount& a, const CellCount& b) {
        return std::pair(a.place, a.surface) < std::pair(b.place, b.surface);
    });
    std::vector<WeightedCell> all;
    for (std::size_t k = 0; k < cells.size();) {
        const std::uint64_t place = cells[k].place;
        double sum = 0, most = 0;
        while (k < cells.size() && cells[k].place == place) {
            const std::uint32_t surface = cells[k].surface;
            double faces = 0;
            for (; k < cells.size() && cells[k].place == place && cells[k].surface == surface; ++k)
                faces += cells[k].faces;
            sum += faces;
            most = std::max(most, faces);
        }
        all.push_back({place, sum + per_curve * std::sqrt(sum - most)});
    }
    return all;
}

} // namespace

std::vector<std::uint64_t> equal_runs(std::vector<CellCount> cell_counts, std::size_t blocks) {
    const auto cells = weighted(std::move(cell_counts));
    double total = 0;
    for (const WeightedCell& c : cells) total += c.weight;
    std::vector<std::uint64_t> splitters;
    double before = 0;
    std::size_t k = 0;
    for (std::size_t b = 1; b < blocks; ++b) {
        const double goal = total * static_cast<double>(b) / static_cast<double>(blocks);
        // A cell goes to the side where more than half of it belongs.
        while (k < cells.size() && before + cells[k].weight / 2 <= goal)
            before += cells[k++].weight;
        splitters.push_back(k < cells.size() ? cells[k].place : UINT64_MAX);
    }
    return splitters;
}

std::vector<std::uint32_t> blocks_of(const BlockGrid& grid,
                                     std::span<const std::uint64_t> splitters, const Box& box) {
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
                if (std::find(blocks.begin(), blocks.end(), b) == blocks.end()) blocks.push_back(b);
            }
    std::sort(blocks.begin(), blocks.end());
    return blocks;
}

} // namespace terrane::distribution
