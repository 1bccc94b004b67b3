// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which triangles are near a box, while they change. Private to improve.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <terrane/algorithms/search/search.hpp>

namespace terrane::improving {

/// Cells of several sizes; a box is entered in cells as large as it is, eight of them at most.
/// Entries are never taken out: what has moved away or is gone is for the visitor to tell.
class Grid {
public:
    /// Empties it. `size`: of the smallest cells.
    void reset(double size);

    [[nodiscard]] std::size_t entries() const { return entries_; }

    /// Enters triangle t of this patch. A triangle may be entered again.
    void enter(std::uint32_t t, const Box& box, std::uint32_t patch);
    /// The same for one that was entered with the box `before`.
    void move(std::uint32_t t, const Box& before, const Box& box, std::uint32_t patch);

    /// Calls visit(t) for at least all triangles entered whose boxes overlap, but for those of the
    /// patch `but`; maybe several times. Ends when visit gives false, and gives that.
    template <class Visit>
    bool visit(const Box& box, std::uint32_t but, const Visit& visit) const {
        for (const Level& level : levels_) {
            if (level.cells.empty()) continue;
            const Range range = range_of(level, box);
            if (range.count() > 2 * static_cast<double>(level.cells.size()) + 64) {
                for (const Cell& cell : level.cells) // the box is large against these cells
                    if (range.contains(cell.at) && !visit_cell(cell, but, visit)) return false;
                continue;
            }
            for (std::int64_t x = range.low.x; x <= range.high.x; ++x)
                for (std::int64_t y = range.low.y; y <= range.high.y; ++y)
                    for (std::int64_t z = range.low.z; z <= range.high.z; ++z) {
                        const Cell* const cell = level.find({x, y, z});
                        if (cell != nullptr && !visit_cell(*cell, but, visit)) return false;
                    }
        }
        return true;
    }

private:
    struct Place {
        std::int64_t x = 0, y = 0, z = 0;

        friend bool operator==(const Place& a, const Place& b) {
            return a.x == b.x && a.y == b.y && a.z == b.z;
        }
    };
    struct Entry {
        std::uint32_t triangle, patch;
    };
    struct Cell {
        Place at{};
        std::uint32_t patch = 0; ///< of all entries, or no_group
        std::vector<Entry> entries;
    };
    struct Range {
        Place low, high;
        [[nodiscard]] double count() const {
            return static_cast<double>(high.x - low.x + 1) *
                   static_cast<double>(high.y - low.y + 1) *
                   static_cast<double>(high.z - low.z + 1);
        }
        [[nodiscard]] bool contains(const Place& p) const {
            return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
                   p.z <= high.z;
        }
        friend bool operator==(const Range&, const Range&) = default;
    };
    struct Level {
        double size = 0;
        std::vector<Cell> cells;
        std::vector<std::uint32_t> slots; ///< open addressing: 1 + index into cells, 0 is free

        [[nodiscard]] const Cell* find(const Place& at) const;
        Cell& find_or_make(const Place& at, std::uint32_t patch);
        void grow();
        [[nodiscard]] std::size_t slot_of(const Place& at) const;
    };

    template <class Visit>
    static bool visit_cell(const Cell& cell, std::uint32_t but, const Visit& visit) {
        if (but != no_group && cell.patch == but) return true;
        for (const Entry& e : cell.entries)
            if ((but == no_group || e.patch != but) && !visit(e.triangle)) return false;
        return true;
    }
    static Range range_of(const Level& level, const Box& box) {
        const auto place = [&](const std::array<double, 3>& p) {
            return Place{cell_of(p[0], level.size), cell_of(p[1], level.size),
                         cell_of(p[2], level.size)};
        };
        return {place(box.low), place(box.high)};
    }
    static std::int64_t cell_of(double x, double size) {
        constexpr double most = 0x1p40; // beyond, all share the last cell: monotone, so still right
        return static_cast<std::int64_t>(std::floor(std::fmin(std::fmax(x / size, -most), most)));
    }
    [[nodiscard]] std::size_t level_of(const Box& box) const;

    std::size_t entries_ = 0;
    std::vector<Level> levels_; ///< each with cells twice as large as those of the one before
};

} // namespace terrane::improving
