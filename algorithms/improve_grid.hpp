// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which triangles are near a box, while they change. Private to improve.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/search/search.hpp>

namespace terrane::improving {

/// A box in the units of a grid. Coordinates are rounded, but the larger is never made the smaller:
/// boxes that overlap do so here.
struct GridBox {
    std::array<float, 3> low, high;

    [[nodiscard]] bool overlaps(const GridBox& o) const {
        // Without branches: most of what is looked at is not that near.
        return static_cast<int>(low[0] <= o.high[0]) & static_cast<int>(o.low[0] <= high[0]) &
               static_cast<int>(low[1] <= o.high[1]) & static_cast<int>(o.low[1] <= high[1]) &
               static_cast<int>(low[2] <= o.high[2]) & static_cast<int>(o.low[2] <= high[2]);
    }
    void widen(const GridBox& by) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], by.low[k]);
            high[k] = std::max(high[k], by.high[k]);
        }
    }
};

/// Cells of several sizes; a box is entered in cells as large as it is, eight of them at most.
class Grid {
public:
    /// Empties it. `origin`: near what comes; `size`: of the smallest cells.
    void reset(const Point3& origin, double size);

    [[nodiscard]] GridBox scaled(const Box& box) const {
        GridBox out{};
        for (std::size_t k = 0; k < 3; ++k) {
            out.low[k] = scaled(box.low[k], k);
            out.high[k] = scaled(box.high[k], k);
        }
        return out;
    }

    /// Enters triangle t of this patch, which is not entered.
    void enter(std::uint32_t t, const GridBox& box, std::uint32_t patch);
    /// Takes out one that was entered with this box.
    void leave(std::uint32_t t, const GridBox& box);
    /// Both, for one of the same patch as before.
    void move(std::uint32_t t, const GridBox& before, const GridBox& box, std::uint32_t patch);

    /// Calls visit(t, box) for all triangles entered whose boxes overlap, but for those of the
    /// patch `but`; maybe several times. Ends when visit gives false, and gives that.
    template <class Visit>
    bool visit(const GridBox& box, std::uint32_t but, const Visit& visit) const {
        for (const Level& level : levels_) {
            if (level.cells.empty()) continue;
            const Range range = range_of(level, box);
            if (range.count() > 2 * static_cast<double>(level.cells.size()) + 64) {
                for (const Cell& cell : level.cells) // the box is large against these cells
                    if (range.contains(cell.at) && !visit_cell(cell, box, but, visit)) return false;
                continue;
            }
            for (std::int32_t x = range.low.x; x <= range.high.x; ++x)
                for (std::int32_t y = range.low.y; y <= range.high.y; ++y)
                    for (std::int32_t z = range.low.z; z <= range.high.z; ++z) {
                        const Cell* const cell = level.find({x, y, z});
                        if (cell != nullptr && !visit_cell(*cell, box, but, visit)) return false;
                    }
        }
        return true;
    }

private:
    struct Place {
        std::int32_t x = 0, y = 0, z = 0;

        friend bool operator==(const Place&, const Place&) = default;
    };
    struct Entry {
        GridBox box;
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
            return (static_cast<double>(high.x) - low.x + 1) *
                   (static_cast<double>(high.y) - low.y + 1) *
                   (static_cast<double>(high.z) - low.z + 1);
        }
        [[nodiscard]] bool contains(const Place& p) const {
            return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
                   p.z <= high.z;
        }
        friend bool operator==(const Range&, const Range&) = default;
    };
    struct Level {
        float inverse = 1; ///< of the size of its cells: a power of two
        std::vector<Cell> cells;
        std::vector<std::uint32_t> slots; ///< open addressing: 1 + index into cells, 0 is free

        [[nodiscard]] const Cell* find(const Place& at) const;
        Cell& find_or_make(const Place& at, std::uint32_t patch);
        void grow();
        [[nodiscard]] std::size_t slot_of(const Place& at) const;
    };

    template <class Visit>
    static bool visit_cell(const Cell& cell, const GridBox& box, std::uint32_t but,
                           const Visit& visit) {
        if (but != no_group && cell.patch == but) return true;
        for (const Entry& e : cell.entries)
            if (e.box.overlaps(box) && (but == no_group || e.patch != but) &&
                !visit(e.triangle, e.box))
                return false;
        return true;
    }
    [[nodiscard]] float scaled(double x, std::size_t axis) const {
        constexpr double most = 0x1p30; // beyond, all is at one place: monotone, so still right
        return static_cast<float>(std::clamp((x - origin_[axis]) * inverse_, -most, most));
    }
    static std::int32_t cell_of(float x) {
        const auto truncated = static_cast<std::int32_t>(x);
        return truncated - static_cast<std::int32_t>(static_cast<float>(truncated) > x);
    }
    static Range range_of(const Level& level, const GridBox& box) {
        const auto place = [&](const std::array<float, 3>& p) {
            return Place{cell_of(p[0] * level.inverse), cell_of(p[1] * level.inverse),
                         cell_of(p[2] * level.inverse)};
        };
        return {place(box.low), place(box.high)};
    }
    [[nodiscard]] std::size_t level_of(const GridBox& box) const;

    std::array<double, 3> origin_{};
    double inverse_ = 1;        ///< of the size of the smallest cells
    std::vector<Level> levels_; ///< each with cells twice as large as those of the one before
};

} // namespace terrane::improving
