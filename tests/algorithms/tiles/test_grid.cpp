// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/grid.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace {

using namespace terrane;
using namespace terrane::tiles;

constexpr Box unit{{0, 0, 0}, {1, 1, 1}};

/// Places beyond runs of the curve, some of which are empty.
std::vector<std::uint64_t> any_splitters(std::mt19937& random, const TileGrid& grid,
                                         std::size_t tiles) {
    std::vector<std::uint64_t> splitters(tiles - 1);
    for (std::uint64_t& s : splitters)
        s = random() % 4 == 0 ? UINT64_MAX : random() % (std::uint64_t{1} << (3 * grid.bits));
    std::sort(splitters.begin(), splitters.end());
    for (std::size_t k = 1; k < splitters.size(); k += 3) splitters[k] = splitters[k - 1];
    return splitters;
}

/// Looks at each cell.
std::vector<std::uint32_t>
tiles_by_cells(const TileGrid& grid, const std::vector<std::uint64_t>& splitters, const Box& box) {
    std::set<std::uint32_t> tiles;
    for (std::uint32_t x = grid.cell(0, box.low[0]); x <= grid.cell(0, box.high[0]); ++x)
        for (std::uint32_t y = grid.cell(1, box.low[1]); y <= grid.cell(1, box.high[1]); ++y)
            for (std::uint32_t z = grid.cell(2, box.low[2]); z <= grid.cell(2, box.high[2]); ++z)
                tiles.insert(tile_at(splitters, grid.place({x, y, z})));
    return {tiles.begin(), tiles.end()};
}

} // namespace

TEST_CASE("grid of tiles: the tiles of a box are those of its cells", "[tiles]") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(-0.1, 1.1);
    std::size_t several = 0, one = 0;
    for (const std::size_t count : {1, 2, 3, 7, 40}) {
        const TileGrid grid = grid_over(unit, count);
        for (unsigned round = 0; round < 20; ++round) {
            const auto splitters = any_splitters(random, grid, count);
            Box box{};
            for (unsigned k = 0; k < 3; ++k) {
                const double a = share(random), b = round % 3 == 0 ? a : share(random);
                box.low[k] = std::min(a, b);
                box.high[k] = std::max(a, b);
            }
            const auto found = tiles_of(grid, splitters, box);
            CHECK(found == tiles_by_cells(grid, splitters, box));
            (found.size() > 1 ? several : one) += 1;
        }
    }
    CHECK(several > 20);
    CHECK(one > 20);
}

TEST_CASE("grid of tiles: a box over very many cells costs no look at each", "[tiles]") {
    TileGrid grid = grid_over(unit, 2);
    grid.bits = 12;                                  // 2^36 cells
    for (double& scale : grid.scale) scale = 0x1p13; // per half of a unit
    std::vector<std::uint64_t> splitters(511);
    for (std::size_t k = 0; k < splitters.size(); ++k)
        splitters[k] = (k + 1) * ((std::uint64_t{1} << 36) / 512) + k;
    std::vector<std::uint32_t> all(512);
    std::iota(all.begin(), all.end(), 0U);
    CHECK(tiles_of(grid, splitters, unit) == all);
}
