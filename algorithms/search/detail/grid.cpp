// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/search/methods.hpp>

namespace terrane::search {
namespace {

double centre(const Box& b, unsigned k) {
    return b.low[k] / 2 + b.high[k] / 2;
}

// Limits the number of cells. Halving the count along the axis with the most cells makes queries
// slower but changes no result.
void cap(std::array<double, 3>& cells, double most) {
    while (cells[0] * cells[1] * cells[2] > most) {
        double& largest = *std::max_element(cells.begin(), cells.end());
        largest = std::max(1.0, std::floor(largest / 2));
    }
}

} // namespace

void CellGrid::choose_cells(std::span<const Box> boxes) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{unbounded, unbounded, unbounded};
    std::array<double, 3> high{-unbounded, -unbounded, -unbounded}, largest{};
    for (const Box& b : boxes)
        for (unsigned k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], b.low[k]);
            high[k] = std::max(high[k], b.high[k]);
            largest[k] = std::max(largest[k], b.high[k] - b.low[k]);
        }
    std::array<double, 3> cells{1, 1, 1};
    const double most = std::max<double>(1, 2.0 * static_cast<double>(boxes.size()));
    for (unsigned k = 0; k < 3 && !boxes.empty(); ++k) {
        const double extent = high[k] - low[k];
        if (extent < unbounded && extent > 0)
            cells[k] = largest[k] > 0 ? std::clamp(std::floor(extent / largest[k]), 1.0, most)
                                      : std::cbrt(most);
    }
    cap(cells, most);
    for (unsigned k = 0; k < 3 && !boxes.empty(); ++k) {
        counts_[k] = static_cast<std::uint32_t>(cells[k]);
        origin_[k] = low[k];
        const double extent = high[k] - low[k];
        size_[k] = extent > 0 && extent < unbounded ? extent / cells[k] : 1;
        // The widening is half of the largest box, not of a cell. The smallest normal number covers
        // the rounding of halves of denormals.
        widening_[k] = largest[k] * 0.5 * (1 + grid_width_share) +
                       grid_size_share * std::max(std::fabs(low[k]), std::fabs(high[k])) +
                       std::numeric_limits<double>::min();
    }
}

CellGrid::CellGrid(std::span<const Box> boxes) {
    choose_cells(boxes);
    starts_.assign(std::size_t{counts_[0]} * counts_[1] * counts_[2] + 1, 0);
    for (const Box& b : boxes) ++starts_[cell_of(b) + 1];
    for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
    stored_.resize(boxes.size());
    auto next = starts_;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        stored_[next[cell_of(boxes[i])]++] = {boxes[i], i};
}

std::uint32_t CellGrid::cell(unsigned axis, double x) const {
    const double c = (x - origin_[axis]) / size_[axis]; // monotone in x even when rounded
    if (!(c > 0)) return 0;
    const double last = counts_[axis] - 1;
    return static_cast<std::uint32_t>(std::min(c, last));
}

std::size_t CellGrid::cell_of(const Box& b) const {
    const std::size_t x = cell(0, centre(b, 0)), y = cell(1, centre(b, 1));
    return (std::size_t{cell(2, centre(b, 2))} * counts_[1] + y) * counts_[0] + x;
}

std::vector<std::uint32_t> boxes_in_mixed_cells(std::span<const Box> boxes,
                                                std::span<const std::uint32_t> groups) {
    std::vector<std::uint32_t> chosen;
    const auto group_of = [&](std::size_t i) { return groups.empty() ? no_group : groups[i]; };
    const CellGrid grid(boxes);
    struct Cell {
        std::uint32_t group = 0;
        enum : std::uint8_t { empty, one, mixed } state = empty;
    };
    std::vector<Cell> cells(grid.cell_count());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        Cell& c = cells[grid.cell_of(boxes[i])];
        const std::uint32_t group = group_of(i);
        const bool same = group != no_group && (c.state == Cell::empty || c.group == group);
        c = {group, same && c.state != Cell::mixed ? Cell::one : Cell::mixed};
    }
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        bool meets = false;
        grid.for_rows(boxes[i], [&](std::size_t c, std::size_t last) {
            for (; c <= last && !meets; ++c)
                meets = cells[c].state == Cell::mixed ||
                        (cells[c].state == Cell::one && cells[c].group != group_of(i));
        });
        if (meets) chosen.push_back(i);
    }
    return chosen;
}

} // namespace terrane::search
