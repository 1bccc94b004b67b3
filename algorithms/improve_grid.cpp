// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/improve_grid.hpp>

#include <algorithm>

namespace terrane::improving {
namespace {

constexpr std::size_t most_levels = 32; ///< the last has one cell for each side of the origin

} // namespace

std::size_t Grid::Level::slot_of(const Place& at) const {
    std::uint64_t h = 0;
    for (const std::int32_t k : {at.x, at.y, at.z}) {
        h = (h ^ static_cast<std::uint32_t>(k)) * 0x9E3779B97F4A7C15ULL;
        h ^= h >> 29U;
    }
    return static_cast<std::size_t>(h) & (slots.size() - 1);
}

const Grid::Cell* Grid::Level::find(const Place& at) const {
    for (std::size_t s = slot_of(at);; s = (s + 1) & (slots.size() - 1)) {
        if (slots[s] == 0) return nullptr;
        const Cell& cell = cells[slots[s] - 1];
        if (cell.at == at) return &cell;
    }
}

void Grid::Level::grow() {
    std::size_t wanted = 64;
    while (wanted < 4 * cells.size()) wanted *= 2;
    slots.assign(wanted, 0);
    for (std::uint32_t c = 0; c < cells.size(); ++c) {
        std::size_t s = slot_of(cells[c].at);
        while (slots[s] != 0) s = (s + 1) & (slots.size() - 1);
        slots[s] = c + 1;
    }
}

Grid::Cell& Grid::Level::find_or_make(const Place& at, std::uint32_t patch) {
    if (2 * (cells.size() + 1) > slots.size()) grow();
    std::size_t s = slot_of(at);
    for (; slots[s] != 0; s = (s + 1) & (slots.size() - 1))
        if (cells[slots[s] - 1].at == at) return cells[slots[s] - 1];
    cells.push_back({at, patch, {}});
    slots[s] = static_cast<std::uint32_t>(cells.size());
    return cells.back();
}

void Grid::reset(const Point3& origin, double size) {
    origin_ = {origin.x, origin.y, origin.z};
    inverse_ = 1 / size;
    levels_.assign(most_levels, {});
    float inverse = 1;
    for (Level& level : levels_) {
        level.inverse = inverse;
        inverse /= 2;
    }
}

std::size_t Grid::level_of(const GridBox& box) const {
    float size = 0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, box.high[k] - box.low[k]);
    std::size_t level = 0;
    while (level + 1 < levels_.size() && size * levels_[level].inverse > 1) ++level;
    return level;
}

void Grid::enter(std::uint32_t t, const GridBox& box, std::uint32_t patch) {
    Level& level = levels_[level_of(box)];
    const Range range = range_of(level, box);
    for (std::int32_t x = range.low.x; x <= range.high.x; ++x)
        for (std::int32_t y = range.low.y; y <= range.high.y; ++y)
            for (std::int32_t z = range.low.z; z <= range.high.z; ++z) {
                Cell& cell = level.find_or_make({x, y, z}, patch);
                if (cell.entries.empty()) cell.patch = patch;
                if (cell.patch != patch) cell.patch = no_group;
                cell.entries.push_back({box, t, patch});
            }
}

void Grid::leave(std::uint32_t t, const GridBox& box) {
    Level& level = levels_[level_of(box)];
    const Range range = range_of(level, box);
    for (std::int32_t x = range.low.x; x <= range.high.x; ++x)
        for (std::int32_t y = range.low.y; y <= range.high.y; ++y)
            for (std::int32_t z = range.low.z; z <= range.high.z; ++z) {
                auto& entries = level.find_or_make({x, y, z}, no_group).entries;
                const auto at = std::find_if(entries.begin(), entries.end(),
                                             [t](const Entry& e) { return e.triangle == t; });
                *at = entries.back();
                entries.pop_back();
            }
}

void Grid::move(std::uint32_t t, const GridBox& before, const GridBox& box, std::uint32_t patch) {
    const std::size_t here = level_of(box);
    Level& level = levels_[here];
    const Range range = range_of(level, box);
    if (level_of(before) != here || !(range_of(level, before) == range)) {
        leave(t, before);
        enter(t, box, patch);
        return;
    }
    for (std::int32_t x = range.low.x; x <= range.high.x; ++x)
        for (std::int32_t y = range.low.y; y <= range.high.y; ++y)
            for (std::int32_t z = range.low.z; z <= range.high.z; ++z)
                for (Entry& e : level.find_or_make({x, y, z}, no_group).entries)
                    if (e.triangle == t) e.box = box;
}

} // namespace terrane::improving
