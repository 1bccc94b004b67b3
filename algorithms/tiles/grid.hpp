// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divides space into tiles: a structured grid of cells (the paper, section 2), and runs of cells
// along a space-filling curve as tiles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::tiles {

/// A grid of 2^bits cells along each axis over the box of all points.
struct TileGrid {
    std::array<double, 3> low{};
    std::array<double, 3> scale{}; ///< cells per unit; 0 where all coordinates are equal
    unsigned bits = 0;

    /// Returns the cell of a coordinate. It never decreases when the coordinate grows.
    [[nodiscard]] std::uint32_t cell(unsigned axis, double x) const {
        const double last = static_cast<double>((std::uint32_t{1} << bits) - 1);
        // Halving keeps the difference of finite numbers finite.
        const double at = (x / 2 - low[axis] / 2) * scale[axis];
        return static_cast<std::uint32_t>(std::clamp(at, 0.0, last));
    }
    /// Returns the place of a cell along the Morton curve.
    [[nodiscard]] std::uint64_t place(const std::array<std::uint32_t, 3>& cell) const {
        std::uint64_t key = 0;
        for (unsigned b = 0; b < bits; ++b)
            for (unsigned k = 0; k < 3; ++k) key |= std::uint64_t{cell[k] >> b & 1U} << (3 * b + k);
        return key;
    }
    [[nodiscard]] std::uint64_t place_of(const std::array<double, 3>& p) const {
        return place({cell(0, p[0]), cell(1, p[1]), cell(2, p[2])});
    }
};

/// Returns the grid of this number of tiles over a box.
TileGrid grid_over(const Box& box, std::size_t tiles);

/// Faces of a surface whose lowest corners are in a cell.
struct CellCount {
    std::uint64_t place = 0;
    std::uint32_t surface = 0, faces = 0;
};

/// Divides the curve into runs of about equal work, and returns the first place beyond each run but the
/// last. `cells` may name a cell and surface several times.
///
/// The work in a cell is estimated from its counts alone: one unit per face and, where several surfaces
/// have faces, 27 units times the square root of the faces of all but the largest. A curve through
/// a cell meets about 3 sqrt(n / 2) of n faces; the time per pair that meets was measured as 13 times that
/// per face (docs/explanation/scale.md).
std::vector<std::uint64_t> equal_runs(std::vector<CellCount> cells, std::size_t tiles);

/// Returns the tile of a place along the curve.
inline std::uint32_t tile_at(std::span<const std::uint64_t> splitters, std::uint64_t place) {
    return static_cast<std::uint32_t>(std::upper_bound(splitters.begin(), splitters.end(), place) -
                                      splitters.begin());
}

/// Returns the tiles whose cells a box overlaps, ascending.
std::vector<std::uint32_t> tiles_of(const TileGrid& grid, std::span<const std::uint64_t> splitters,
                                    const Box& box);

/// Returns the tile with the lowest corner of a box: it owns the face with this box, and the pair
/// with this common part of its boxes.
inline std::uint32_t owner_of(const TileGrid& grid, std::span<const std::uint64_t> splitters,
                              const std::array<double, 3>& lowest) {
    return tile_at(splitters, grid.place_of(lowest));
}

} // namespace terrane::tiles
