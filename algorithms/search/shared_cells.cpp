// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/shared_cells.hpp>

#include <bit>
#include <limits>

namespace terrane::search {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void extend(Box& b, const Box& by) {
    for (unsigned k = 0; k < 3; ++k) {
        b.low[k] = std::min(b.low[k], by.low[k]);
        b.high[k] = std::max(b.high[k], by.high[k]);
    }
}

Box common(const Box& a, const Box& b) {
    Box c = a;
    for (unsigned k = 0; k < 3; ++k) {
        c.low[k] = std::max(a.low[k], b.low[k]);
        c.high[k] = std::min(a.high[k], b.high[k]);
        if (c.low[k] > c.high[k]) return empty_box;
    }
    return c;
}

/// Per group the box of all boxes of other groups; boxes without group are one more group.
struct Regions {
    std::vector<Box> of_others; ///< per group, last for no_group; empty_box: none
    Box any = empty_box;        ///< holds all places where boxes of different groups meet

    [[nodiscard]] const Box& of(std::uint32_t group) const {
        return of_others[std::min<std::size_t>(group, of_others.size() - 1)];
    }
};

/// Groups numbered sparsely are taken as one that meets itself.
std::size_t group_count(std::span<const std::uint32_t> groups) {
    std::uint32_t count = 0;
    for (const std::uint32_t g : groups)
        if (g != no_group) count = std::max(count, g + 1);
    return count <= groups.size() ? count : 0;
}

Regions regions_of(std::span<const Box> boxes, std::span<const std::uint32_t> groups) {
    const std::size_t count = group_count(groups);
    std::vector<Box> own(count + 1, empty_box);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        extend(own[std::min<std::size_t>(groups[i], count)], boxes[i]);
    Regions r;
    r.of_others.assign(count + 1, empty_box);
    Box before = empty_box, behind = empty_box;
    for (std::size_t g = 0; g <= count; ++g) {
        extend(r.of_others[g], before);
        extend(before, own[g]);
    }
    for (std::size_t g = count + 1; g-- > 0;) {
        extend(r.of_others[g], behind);
        extend(behind, own[g]);
    }
    extend(r.of_others[count], own[count]);
    for (std::size_t g = 0; g <= count; ++g) extend(r.any, common(own[g], r.of_others[g]));
    return r;
}

/// Cells of 2^shift lattice units, about as large as the mean of some of the boxes, and at most
/// about one per box.
class Cells {
public:
    Cells(std::span<const Box> boxes, const Lattice& lattice) {
        std::array<std::uint64_t, 3> sum{};
        const std::size_t step = boxes.size() / 2048 + 1;
        for (std::size_t i = 0; i < boxes.size(); i += step) {
            const PackedBox b = lattice.pack(boxes[i]);
            for (unsigned k = 0; k < 3; ++k) sum[k] += (b.high_of(k) - b.low_of(k) + 1) * step;
        }
        std::array<unsigned, 3> bits{};
        for (unsigned k = 0; k < 3; ++k)
            bits[k] = PackedBox::bits + 1 -
                      static_cast<unsigned>(std::bit_width(sum[k] / boxes.size() + 1));
        const auto most = static_cast<unsigned>(std::bit_width(boxes.size()));
        for (unsigned k = 0; bits[0] + bits[1] + bits[2] > most; k = (k + 1) % 3)
            if (bits[k] > 0) --bits[k];
        for (unsigned k = 0; k < 3; ++k) shift_[k] = PackedBox::bits - bits[k];
        row_ = std::size_t{1} << bits[0];
        layer_ = row_ << bits[1];
        count_ = layer_ << bits[2];
    }

    [[nodiscard]] std::size_t count() const { return count_; }

    /// Number of cells that a box overlaps.
    [[nodiscard]] std::size_t covered(const PackedBox& b) const {
        const Range r = range(b);
        return (r.to[0] - r.from[0] + 1) * (r.to[1] - r.from[1] + 1) * (r.to[2] - r.from[2] + 1);
    }

    /// Calls visit(cell) until it returns true; says whether it did.
    template <class Visit>
    bool any_of(const PackedBox& b, const Visit& visit) const {
        const Range r = range(b);
        for (std::size_t z = r.from[2]; z <= r.to[2]; ++z)
            for (std::size_t y = r.from[1]; y <= r.to[1]; ++y)
                for (std::size_t x = r.from[0]; x <= r.to[0]; ++x)
                    if (visit(z * layer_ + y * row_ + x)) return true;
        return false;
    }

private:
    struct Range {
        std::array<std::size_t, 3> from, to;
    };

    [[nodiscard]] Range range(const PackedBox& b) const {
        Range r{};
        for (unsigned k = 0; k < 3; ++k) {
            r.from[k] = b.low_of(k) >> shift_[k];
            r.to[k] = b.high_of(k) >> shift_[k];
        }
        return r;
    }

    std::array<unsigned, 3> shift_{};
    std::size_t row_ = 1, layer_ = 1, count_ = 1;
};

/// Boxes within their region of which some cell is shared. `enter(cell, i)` for all cells of all
/// boxes that mark theirs (marks(i)), then `shared(cell)`. Where the boxes that mark cover too many
/// cells, all boxes within their region.
template <class Region, class Marks, class Enter, class Shared>
Selection select(std::span<const Box> boxes, const Lattice& lattice, const Cells& cells,
                 const Region& region, const Marks& marks, const Enter& enter,
                 const Shared& shared) {
    std::size_t work = 16 * boxes.size() + 4096;
    bool filtered = true;
    for (std::uint32_t i = 0; i < boxes.size() && filtered; ++i) {
        if (!marks(i) || !boxes[i].overlaps(region(i))) continue;
        const PackedBox b = lattice.pack(boxes[i]);
        const std::size_t covered = cells.covered(b);
        filtered = covered <= work;
        work -= filtered ? covered : 0;
        if (filtered) cells.any_of(b, [&](std::size_t c) { return enter(c, i), false; });
    }
    Selection s;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].overlaps(region(i))) continue;
        const PackedBox b = lattice.pack(boxes[i]);
        if (filtered && !cells.any_of(b, shared)) continue;
        s.boxes.push_back(b);
        s.indices.push_back(i);
    }
    return s;
}

Box bounds_of(std::span<const Box> boxes) {
    Box all = empty_box;
    for (const Box& b : boxes) extend(all, b);
    return all;
}

} // namespace

Selection select_all(std::span<const Box> boxes) {
    if (boxes.empty()) return {};
    const Lattice lattice(bounds_of(boxes));
    Selection s;
    s.boxes.resize(boxes.size());
    s.indices.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        s.boxes[i] = lattice.pack(boxes[i]);
        s.indices[i] = i;
    }
    return s;
}

Selection select_meeting(std::span<const Box> boxes, std::span<const std::uint32_t> groups) {
    const Regions regions = regions_of(boxes, groups);
    if (regions.any.low[0] > regions.any.high[0]) return {};
    const Lattice lattice(regions.any);
    const Cells cells(boxes, lattice);
    constexpr std::uint32_t mixed = no_group, empty = mixed - 1; // no_group mixes
    std::vector<std::uint32_t> groups_in(cells.count(), empty);
    const auto enter = [&](std::size_t c, std::uint32_t i) {
        const std::uint32_t group = groups[i] == empty ? mixed : groups[i];
        groups_in[c] = groups_in[c] == empty || groups_in[c] == group ? group : mixed;
    };
    return select(
        boxes, lattice, cells, [&](std::uint32_t i) -> const Box& { return regions.of(groups[i]); },
        [](std::uint32_t) { return true; }, enter,
        [&](std::size_t c) { return groups_in[c] == mixed; });
}

Selection select_near(std::span<const Box> boxes, std::span<const std::uint32_t> active) {
    if (active.empty()) return {};
    Box region = empty_box;
    std::vector<bool> is_active(boxes.size());
    for (const std::uint32_t i : active) {
        extend(region, boxes[i]);
        is_active[i] = true;
    }
    const Lattice lattice(region);
    const Cells cells(boxes, lattice);
    std::vector<bool> near(cells.count());
    return select(
        boxes, lattice, cells, [&](std::uint32_t) -> const Box& { return region; },
        [&](std::uint32_t i) { return is_active[i]; },
        [&](std::size_t c, std::uint32_t) { near[c] = true; },
        [&](std::size_t c) { return near[c]; });
}

} // namespace terrane::search
