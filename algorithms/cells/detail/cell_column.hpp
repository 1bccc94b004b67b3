// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The shares of blocks in the cells of one column of a grid.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/cells/detail/cell_pieces.hpp>

namespace terrane::cells::detail {

/// The share of a block in a cell of a column.
struct LayerShare {
    std::uint64_t layer = 0;
    BlockShare share{};
};

/// Walks down a column. Precondition: the rounding mode is "to nearest".
class CellColumn {
public:
    CellColumn(const Mesh& mesh, const Volumes& volumes, const RectilinearGrid& grid) :
        mesh_(mesh), volumes_(volumes), grid_(grid), places_(grid) {}

    /// Tells of which layers the block of the centre is needed, from the top down.
    template <class Visit>
    void for_located(std::uint64_t column, std::span<const CellPiece> pieces,
                     const Visit& visit) const {
        auto next = pieces.begin();
        bool was_divided = true;
        for (std::uint64_t k = places_.nz + 1; k-- > 0;) {
            const std::uint64_t place = places_.of(column, k);
            const bool has_pieces = next != pieces.end() && next->place == place;
            while (next != pieces.end() && next->place == place) ++next;
            if (k < places_.nz && (has_pieces || was_divided)) visit(k);
            was_divided = has_pieces || k == places_.nz;
        }
    }

    /// Appends the shares in the layers of a column, from the top down, and calls set_block(layer, block) with the
    /// blocks of the centres. `located` are those of the layers that for_located() tells.
    template <class SetBlock>
    void operator()(std::uint64_t column, std::span<const CellPiece> pieces,
                    std::span<const std::uint32_t> located, std::vector<LayerShare>& out,
                    const SetBlock& set_block) {
        begin(pieces);
        auto known = located.begin();
        std::uint32_t block = 0;
        bool was_divided = true;
        for (std::uint64_t k = places_.nz + 1; k-- > 0;) {
            const auto here = take(places_.of(column, k));
            if (k < places_.nz) {
                if (!here.empty() || was_divided) block = *known++;
                set_block(k, block);
                add_shares(k, here, block, out);
            }
            pass(here);
            was_divided = !here.empty() || k == places_.nz;
        }
    }

private:
    using Pieces = std::span<const CellPiece>;
    using Areas = std::map<std::uint32_t, DoubleDouble>;

    void begin(Pieces pieces);
    /// Takes the pieces at a place, the next one from above.
    Pieces take(std::uint64_t place);
    /// Adds the shares of the blocks in a cell.
    void add_shares(std::uint64_t layer, Pieces here, std::uint32_t block,
                    std::vector<LayerShare>& out);
    /// Takes the pieces of a cell into the areas above the next one.
    void pass(Pieces here);
    /// Begins anew below the top of a cell that one block fills.
    void begin_filled(std::uint32_t block, Pieces here);
    [[nodiscard]] double fraction_of(std::uint32_t block, const DoubleDouble& moment,
                                     Pieces here) const;
    [[nodiscard]] double exact_fraction(std::uint32_t block, Pieces here) const;
    /// Calls add(block, sign) for the sides of a triangle: 1 for the block behind it.
    template <class Add>
    void for_sides(std::uint32_t triangle, const Add& add) const {
        const auto& [front, back] = volumes_.of_sides[triangle];
        add(front, -1);
        add(back, 1);
    }

    const Mesh& mesh_;
    const Volumes& volumes_;
    const RectilinearGrid& grid_;
    PlacesOfPieces places_;
    Pieces pieces_;
    std::size_t taken_ = 0;
    Areas areas_; ///< per block: twice its area in the top of the cell, whose area is 1; others: 0
    std::size_t summed_ = 0;    ///< from this piece on they are summed
    std::uint32_t filling_ = 0; ///< the block that had the whole area there
};

} // namespace terrane::cells::detail
