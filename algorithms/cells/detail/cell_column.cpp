// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/cells/detail/cell_column.hpp>

#include <cmath>
#include <stdexcept>

#include <terrane/kernel/nearest.hpp>

namespace terrane::cells::detail {
namespace {

/// Throws unless a number may be the one that it must be.
void require_near(const DoubleDouble& number, double expected) {
    const DoubleDouble off = number - DoubleDouble(expected);
    if (std::fabs(off.value()) > off.error())
        throw std::logic_error("the blocks in a cell do not fill it");
}

} // namespace

void CellColumn::begin(Pieces pieces) {
    pieces_ = pieces;
    taken_ = 0;
    begin_filled(0, {}); // far above, the outside is everywhere
}

CellColumn::Pieces CellColumn::take(std::uint64_t place) {
    const std::size_t first = taken_;
    while (taken_ < pieces_.size() && pieces_[taken_].place == place) ++taken_;
    return pieces_.subspan(first, taken_ - first);
}

void CellColumn::begin_filled(std::uint32_t block, Pieces here) {
    areas_.clear();
    areas_.emplace(block, DoubleDouble(2));
    filling_ = block;
    summed_ = taken_ - here.size();
}

void CellColumn::pass(Pieces here) {
    in_twofold([&] {
        for (const CellPiece& piece : here)
            for_sides(piece.triangle, [&](std::uint32_t block, int sign) {
                DoubleDouble& area = areas_[block];
                area = sign > 0 ? area + piece.moments.area : area - piece.moments.area;
            });
    });
}

void CellColumn::add_shares(std::uint64_t layer, Pieces here, std::uint32_t block,
                            std::vector<LayerShare>& out) {
    Areas moments; // of the blocks with volume in the cell
    in_twofold([&] {
        for (const CellPiece& piece : here) {
            if (!piece.divides) continue;
            for_sides(piece.triangle, [&](std::uint32_t of, int sign) {
                DoubleDouble& moment = moments[of];
                moment = sign > 0 ? moment + piece.moments.moment : moment - piece.moments.moment;
            });
        }
    });
    if (moments.empty()) moments.emplace(block, DoubleDouble());
    DoubleDouble filled;
    for (const auto& [of, moment] : moments)
        if (const auto area = areas_.find(of); area != areas_.end()) filled = filled + area->second;
    require_near(filled, 2);
    if (moments.size() == 1) {
        out.push_back({layer, {BlockId(block), 1}});
        return begin_filled(block, here);
    }
    for (const auto& [of, moment] : moments)
        out.push_back({layer, {BlockId(of), fraction_of(of, moment, here)}});
}

double CellColumn::fraction_of(std::uint32_t block, const DoubleDouble& moment, Pieces here) const {
    const auto found = areas_.find(block);
    const DoubleDouble area = found == areas_.end() ? DoubleDouble() : found->second;
    const auto nearest =
        in_twofold([&] { return ((DoubleDouble(3) * area + moment) / DoubleDouble(6)).nearest(); });
    if (nearest && std::isfinite(*nearest)) return *nearest;
    return exact_fraction(block, here);
}

double CellColumn::exact_fraction(std::uint32_t block, Pieces here) const {
    const std::size_t first = taken_ - here.size();
    mpq_class sum = filling_ == block ? 6 : 0;
    for (std::size_t n = summed_; n < taken_; ++n) {
        const CellPiece& piece = pieces_[n];
        const bool is_here = n >= first;
        if (is_here && !piece.divides) continue;
        const CutTriangle triangle(corners_in(mesh_, piece.triangle));
        if (triangle.is_vertical()) continue;
        const CellBox box = box_at(grid_, piece.place);
        const auto part = part_at(triangle, grid_, piece.place);
        for_sides(piece.triangle, [&](std::uint32_t of, int sign) {
            if (of != block) return;
            const auto moments = MomentsOfPart<mpq_class>(part, box)(is_here);
            sum += sign * (is_here ? moments.moment : mpq_class(3 * moments.area));
        });
    }
    sum /= 6;
    return nearest_quotient(Exact(sum.get_num()), Exact(sum.get_den()));
}

} // namespace terrane::cells::detail
