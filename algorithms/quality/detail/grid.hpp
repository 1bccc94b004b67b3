// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the triangles near a box while the mesh changes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::quality::detail {

/// A box in the units of a grid. Rounding of coordinates is monotone, so boxes that overlap in
/// space overlap here.
struct GridBox {
    std::array<float, 3> low, high;

    [[nodiscard]] bool overlaps(const GridBox& o) const {
        // No branches: most boxes compared do not overlap.
        return static_cast<int>(low[0] <= o.high[0]) & static_cast<int>(o.low[0] <= high[0]) &
               static_cast<int>(low[1] <= o.high[1]) & static_cast<int>(o.low[1] <= high[1]) &
               static_cast<int>(low[2] <= o.high[2]) & static_cast<int>(o.low[2] <= high[2]);
    }
    /// Tells whether the boxes overlap when projected along the axis.
    [[nodiscard]] bool overlaps_along(Axis axis, const GridBox& o) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (k != static_cast<std::size_t>(axis) && (low[k] > o.high[k] || o.low[k] > high[k]))
                return false;
        return true;
    }
    void widen(const GridBox& by) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], by.low[k]);
            high[k] = std::max(high[k], by.high[k]);
        }
    }
};

/// A hierarchical hash grid. A box is stored in the cell of its lowest corner, at the level whose
/// cells are as large as the box, so a query extends its range by one cell downwards. Several cells
/// may share a bucket, which does no harm, as boxes are compared.
class TriangleGrid {
public:
    /// Empties the grid. `origin` should be near the triangles to come; `size` is that of the
    /// smallest cells.
    void reset(const Point3& origin, double size);

    [[nodiscard]] GridBox scaled(const Box& box) const {
        GridBox out{};
        for (std::size_t k = 0; k < 3; ++k) {
            out.low[k] = scaled(box.low[k], k);
            out.high[k] = scaled(box.high[k], k);
        }
        return out;
    }

    /// Adds triangle t, which belongs to this patch and must not be in the grid.
    void enter(std::uint32_t t, const GridBox& box, std::uint32_t patch);
    /// Removes a triangle that was added with this box.
    void leave(std::uint32_t t, const GridBox& box);
    /// Replaces the box of a triangle whose patch stays the same.
    void move(std::uint32_t t, const GridBox& before, const GridBox& box, std::uint32_t patch);

    /// Calls visit(t, box) for all triangles whose boxes overlap the box, except those of patch
    /// `but`; some of them may be visited several times. Stops when a visit returns false, and
    /// returns false then.
    template <class Visit>
    bool visit(const GridBox& box, std::uint32_t but, const Visit& visit) const {
        for (const Level& level : levels_) {
            if (level.entries.empty()) continue;
            const Range range = range_round(level, box);
            if (range.count() > static_cast<double>(level.entries.size())) {
                for (std::size_t b = 0; b < level.entries.size(); ++b)
                    if (!visit_bucket(level, b, box, but, visit)) return false;
                continue;
            }
            for (std::int32_t z = range.low.z; z <= range.high.z; ++z)
                for (std::int32_t y = range.low.y; y <= range.high.y; ++y)
                    for (std::int32_t x = range.low.x; x <= range.high.x; ++x)
                        if (!visit_bucket(level, level.bucket_of({x, y, z}), box, but, visit))
                            return false;
        }
        return true;
    }

private:
    static constexpr std::uint32_t vacant = no_group - 1;

    struct Place {
        std::int32_t x = 0, y = 0, z = 0;

        friend bool operator==(const Place&, const Place&) = default;
    };
    struct Entry {
        GridBox box;
        std::uint32_t triangle, patch;
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
    };
    struct Level {
        float inverse = 1; ///< 1 / size of its cells; a power of two
        std::size_t count = 0;
        std::vector<std::uint32_t> patch_of; ///< per bucket: the patch of all its entries; no_group
                                             ///< if they differ; vacant
        std::vector<std::vector<Entry>> entries; ///< per bucket; their number is zero or a power of
                                                 ///< two

        /// Cells adjacent along x have adjacent buckets.
        [[nodiscard]] std::size_t bucket_of(const Place& at) const {
            const std::uint32_t place = static_cast<std::uint32_t>(at.x) +
                                        static_cast<std::uint32_t>(at.y) * 0x9E3779B1U +
                                        static_cast<std::uint32_t>(at.z) * 0x85EBCA77U;
            return place & (patch_of.size() - 1);
        }
        void enter(const Entry& entry);
        void grow();
    };

    template <class Visit>
    static bool visit_bucket(const Level& level, std::size_t b, const GridBox& box,
                             std::uint32_t but, const Visit& visit) {
        const std::uint32_t patch = level.patch_of[b];
        if (patch == vacant || (but != no_group && patch == but)) return true;
        for (const Entry& e : level.entries[b])
            if (e.box.overlaps(box) && (but == no_group || e.patch != but) &&
                !visit(e.triangle, e.box))
                return false;
        return true;
    }
    [[nodiscard]] float scaled(double x, std::size_t axis) const {
        constexpr double most = 0x1p30; // all points farther out share a place; the map stays
                                        // monotone
        return static_cast<float>(std::clamp((x - origin_[axis]) * inverse_, -most, most));
    }
    static std::int32_t cell_of(double x) {
        const auto truncated = static_cast<std::int32_t>(x);
        return truncated - static_cast<std::int32_t>(static_cast<double>(truncated) > x);
    }
    /// Returns the cell of a point that is moved down by `down` cells.
    static Place place_of(const Level& level, const std::array<float, 3>& p, double down = 0) {
        const double inverse = level.inverse;
        return {cell_of(p[0] * inverse - down), cell_of(p[1] * inverse - down),
                cell_of(p[2] * inverse - down)};
    }
    /// Returns the cells whose boxes may overlap this one.
    static Range range_round(const Level& level, const GridBox& box) {
        constexpr double size = 1 + 0x1p-20; // of a box, in cells, including rounding
        return {place_of(level, box.low, size), place_of(level, box.high)};
    }
    [[nodiscard]] std::size_t level_of(const GridBox& box) const;

    std::array<double, 3> origin_{};
    double inverse_ = 1;        ///< 1 / size of the smallest cells
    std::vector<Level> levels_; ///< cells double in size from one to the next
};

} // namespace terrane::quality::detail
