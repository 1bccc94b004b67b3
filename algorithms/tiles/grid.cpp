// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/grid.hpp>

#include <bit>
#include <cmath>
#include <utility>

namespace terrane::tiles {

TileGrid grid_over(const Box& box, std::size_t tiles) {
    // Surfaces fill about 4^bits cells. Some hundred cells per tile balance within a few per cent.
    constexpr unsigned most_bits = 12;
    TileGrid grid;
    grid.bits = std::min(most_bits, 4 + static_cast<unsigned>(std::bit_width(tiles)) / 2);
    if (tiles == 1) grid.bits = 0;
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

std::vector<std::uint64_t> equal_runs(std::vector<CellCount> cell_counts, std::size_t tiles) {
    const auto cells = weighted(std::move(cell_counts));
    double total = 0;
    for (const WeightedCell& c : cells) total += c.weight;
    std::vector<std::uint64_t> splitters;
    double before = 0;
    std::size_t k = 0;
    for (std::size_t b = 1; b < tiles; ++b) {
        const double goal = total * static_cast<double>(b) / static_cast<double>(tiles);
        // A cell goes to the side where more than half of it belongs.
        while (k < cells.size() && before + cells[k].weight / 2 <= goal)
            before += cells[k++].weight;
        splitters.push_back(k < cells.size() ? cells[k].place : UINT64_MAX);
    }
    return splitters;
}

namespace {

/// Finds the tiles of the cells in a box of cells. A cube of cells with one corner at a multiple of its side is a run
/// of the curve, so that cubes within one tile need not be divided.
class TilesOfCells {
public:
    TilesOfCells(const TileGrid& grid, std::span<const std::uint64_t> splitters,
                 const std::array<std::uint32_t, 3>& low,
                 const std::array<std::uint32_t, 3>& high) :
        grid_(grid),
        splitters_(splitters), low_(low), high_(high) {
        visit({0, 0, 0}, grid.bits);
    }

    /// Returns the tiles, ascending.
    [[nodiscard]] std::vector<std::uint32_t> take() { return std::move(tiles_); }

private:
    /// Visits the cube with this lowest cell and 2^bits cells along each side, in the order of the curve.
    void visit(const std::array<std::uint32_t, 3>& lowest, unsigned bits) {
        const std::uint32_t side = std::uint32_t{1} << bits;
        for (unsigned k = 0; k < 3; ++k)
            if (lowest[k] > high_[k] || lowest[k] + (side - 1) < low_[k]) return;
        const std::uint64_t first = grid_.place(lowest);
        const std::uint64_t last = first + ((std::uint64_t{1} << 3 * bits) - 1);
        const std::uint32_t from = tile_at(splitters_, first), to = tile_at(splitters_, last);
        if (from == to) {
            if (tiles_.empty() || tiles_.back() != from) tiles_.push_back(from);
            return;
        }
        if (!tiles_.empty() && tiles_.back() == to) return;
        const std::uint32_t half = side / 2;
        for (std::uint32_t child = 0; child < 8; ++child)
            visit({lowest[0] + half * (child & 1U), lowest[1] + half * (child >> 1U & 1U),
                   lowest[2] + half * (child >> 2U)},
                  bits - 1);
    }

    const TileGrid& grid_;
    std::span<const std::uint64_t> splitters_;
    const std::array<std::uint32_t, 3>&low_, &high_;
    std::vector<std::uint32_t> tiles_; ///< found so far, ascending as those along the curve do
};

} // namespace

std::vector<std::uint32_t> tiles_of(const TileGrid& grid, std::span<const std::uint64_t> splitters,
                                    const Box& box) {
    std::array<std::uint32_t, 3> low{}, high{};
    for (unsigned k = 0; k < 3; ++k) {
        low[k] = grid.cell(k, box.low[k]);
        high[k] = grid.cell(k, box.high[k]);
    }
    return TilesOfCells(grid, splitters, low, high).take();
}

} // namespace terrane::tiles
