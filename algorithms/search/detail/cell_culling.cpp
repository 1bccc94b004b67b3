// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/detail/cell_culling.hpp>

#include <bit>
#include <limits>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>

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

bool is_empty(const Box& b) {
    return b.low[0] > b.high[0];
}

/// Groups of eight consecutive boxes. Triangles adjacent in a file are usually adjacent in space.
struct Blocks {
    static constexpr std::uint32_t size = 8;

    std::vector<Box> boxes;  ///< per block: the bounding box of its boxes
    std::vector<char> alike; ///< per block: 1 if all its boxes have the same group, else 0

    Blocks(const BoxSource& all, std::span<const std::uint32_t> groups, const Run& run) :
        boxes((all.size() + size - 1) / size), alike(boxes.size()) {
        for_ranges(boxes.size(), run, [&](std::size_t first, std::size_t last) {
            for (auto k = static_cast<std::uint32_t>(first); k < last; ++k) {
                Box box = all[std::size_t{k} * size];
                bool same = true;
                for_each(k, all.size(), [&](std::uint32_t i) {
                    extend(box, all[i]);
                    if (!groups.empty()) same = same && groups[i] == groups[k * size];
                });
                boxes[k] = box;
                alike[k] = same ? 1 : 0;
            }
        });
    }

    template <class Visit>
    static void for_each(std::uint32_t block, std::size_t count, const Visit& visit) {
        const auto end = static_cast<std::uint32_t>(
            std::min<std::size_t>(count, (std::size_t{block} + 1) * size));
        for (std::uint32_t i = block * size; i < end; ++i) visit(i);
    }
};

/// For each group, the bounding box of all boxes of other groups. Boxes without group form one more
/// group.
class Regions {
public:
    Regions(const BoxSource& boxes, std::span<const std::uint32_t> groups, const Blocks& blocks,
            const Run& run) :
        last_(group_count(groups, run)) {
        const auto parts = parts_of_ranges<std::vector<Box>>(
            blocks.boxes.size(), run, [&](std::size_t first, std::size_t last) {
                std::vector<Box> own(last_ + 1, empty_box);
                for (auto k = static_cast<std::uint32_t>(first); k < last; ++k)
                    if (blocks.alike[k] != 0)
                        extend(own[place(groups[k * Blocks::size])], blocks.boxes[k]);
                    else
                        Blocks::for_each(k, boxes.size(), [&](std::uint32_t i) {
                            extend(own[place(groups[i])], boxes[i]);
                        });
                return own;
            });
        std::vector<Box> own = parts.front();
        for (std::size_t k = 1; k < parts.size(); ++k)
            for (std::size_t g = 0; g < own.size(); ++g) extend(own[g], parts[k][g]);
        unite_others(own);
    }

    /// Returns a region that every box of the group which meets one of another group overlaps;
    /// empty_box if there are no boxes of other groups.
    [[nodiscard]] const Box& of(std::uint32_t group) const { return of_others_[place(group)]; }
    /// Returns a region that contains all contacts between boxes of different groups.
    [[nodiscard]] const Box& any() const { return any_; }

private:
    /// Returns the number of groups. Sparsely numbered groups count as boxes without group.
    static std::size_t group_count(std::span<const std::uint32_t> groups, const Run& run) {
        const auto counts = parts_of_ranges<std::size_t>(
            groups.size(), run, [&](std::size_t first, std::size_t last) {
                std::uint32_t most = 0; // one more than the largest; no_group + 1 wraps to 0
                for (const std::uint32_t g : groups.subspan(first, last - first))
                    most = std::max(most, g + 1);
                return std::size_t{most};
            });
        const std::size_t count = *std::max_element(counts.begin(), counts.end());
        return count <= groups.size() ? count : 0;
    }

    [[nodiscard]] std::size_t place(std::uint32_t group) const {
        return std::min<std::size_t>(group, last_);
    }

    void unite_others(const std::vector<Box>& own) {
        of_others_.assign(own.size(), empty_box);
        Box before = empty_box, behind = empty_box;
        for (std::size_t g = 0; g < own.size(); ++g) {
            extend(of_others_[g], before);
            extend(before, own[g]);
        }
        for (std::size_t g = own.size(); g-- > 0;) {
            extend(of_others_[g], behind);
            extend(behind, own[g]);
        }
        extend(of_others_[last_], own[last_]);
        for (std::size_t g = 0; g < own.size(); ++g) extend(any_, common(own[g], of_others_[g]));
    }

    std::size_t last_;           ///< index of the boxes without group
    std::vector<Box> of_others_; ///< per group
    Box any_ = empty_box;
};

/// A grid of cells of 2^shift lattice units. They are about as large as the mean box of a sample,
/// and there is at most about one cell for every two boxes.
class Cells {
public:
    Cells(const BoxSource& boxes, const Lattice& lattice) {
        std::array<std::uint64_t, 3> sum{};
        const std::size_t step = boxes.size() / 2048 + 1;
        for (std::size_t i = 0; i < boxes.size(); i += step) {
            const PackedBox b = lattice.pack(boxes[i]);
            for (unsigned k = 0; k < 3; ++k) sum[k] += (b.high_of(k) - b.low_of(k) + 1) * step;
        }
        std::array<int, 3> bits{};
        for (unsigned k = 0; k < 3; ++k)
            bits[k] = std::max(0, 1 + static_cast<int>(PackedBox::bits) -
                                      static_cast<int>(std::bit_width(sum[k] / boxes.size() + 1)));
        const auto most = static_cast<int>(std::bit_width(boxes.size() / 8));
        for (unsigned k = 0; bits[0] + bits[1] + bits[2] > most; k = (k + 1) % 3)
            if (bits[k] > 0) --bits[k];
        for (unsigned k = 0; k < 3; ++k)
            shift_[k] = PackedBox::bits - static_cast<unsigned>(bits[k]);
        row_ = std::size_t{1} << bits[0];
        layer_ = row_ << bits[1];
        in_.assign(layer_ << bits[2], empty);
    }

    /// Returns the number of cells that a box overlaps.
    [[nodiscard]] std::size_t covered(const PackedBox& b) const {
        const Range r = range(b);
        return (r.to[0] - r.from[0] + 1) * (r.to[1] - r.from[1] + 1) * (r.to[2] - r.from[2] + 1);
    }

    [[nodiscard]] std::size_t row_count() const { return in_.size() / row_; }

    /// Enters a box of a group in its cells of rows [first, last). no_group makes cells mixed.
    void enter(const PackedBox& b, std::uint32_t group, std::size_t first, std::size_t last) {
        if (group == empty) group = mixed;
        any_of(
            b,
            [&](std::size_t cell) {
                std::uint32_t& in = in_[cell];
                in = in == empty || in == group ? group : mixed;
                return false;
            },
            first, last);
    }

    [[nodiscard]] bool meets_mixed(const PackedBox& b) const {
        return any_of(b, [this](std::size_t cell) { return in_[cell] == mixed; });
    }

private:
    static constexpr std::uint32_t mixed = no_group, empty = mixed - 1;

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

    /// Calls visit for the box's cells of rows [first, last) until it returns true. Returns whether
    /// it did.
    template <class Visit>
    bool any_of(const PackedBox& b, const Visit& visit, std::size_t first = 0,
                std::size_t last = SIZE_MAX) const {
        const Range r = range(b);
        const std::size_t rows = layer_ / row_;
        for (std::size_t z = r.from[2]; z <= r.to[2]; ++z)
            for (std::size_t y = r.from[1]; y <= r.to[1]; ++y) {
                const std::size_t at = z * rows + y;
                if (at < first || at >= last) continue;
                for (std::size_t x = r.from[0]; x <= r.to[0]; ++x)
                    if (visit(at * row_ + x)) return true;
            }
        return false;
    }

    std::array<unsigned, 3> shift_{};
    std::size_t row_ = 1, layer_ = 1;
    std::vector<std::uint32_t> in_; ///< per cell: the group of its boxes, or empty, or mixed
};

/// A block that covers more cells is entered box by box.
constexpr std::size_t most_cells = 2 * Blocks::size;

/// Returns the number of cells that all boxes together may cover.
constexpr std::size_t most_covered(std::size_t boxes) {
    return 16 * boxes + 4096;
}

/// Calls visit(packed box, group) for all boxes of blocks [first, last) that overlap the region of
/// their group; once for the whole block if it is compact.
template <class Visit>
void for_entries(const BoxSource& boxes, std::span<const std::uint32_t> groups,
                 const Blocks& blocks, const Regions& regions, const Lattice& lattice,
                 const Cells& cells, std::size_t first, std::size_t last, const Visit& visit) {
    for (auto k = static_cast<std::uint32_t>(first); k < last; ++k) {
        if (blocks.alike[k] != 0) {
            const std::uint32_t group = groups[k * Blocks::size];
            if (!blocks.boxes[k].overlaps(regions.of(group))) continue;
            const PackedBox b = lattice.pack(blocks.boxes[k]);
            if (cells.covered(b) <= most_cells) {
                visit(b, group);
                continue;
            }
        }
        Blocks::for_each(k, boxes.size(), [&](std::uint32_t i) {
            if (boxes[i].overlaps(regions.of(groups[i]))) visit(lattice.pack(boxes[i]), groups[i]);
        });
    }
}

/// Boxes to be entered and their groups.
struct Entries {
    std::vector<std::pair<PackedBox, std::uint32_t>> boxes;
    std::size_t covered = 0; ///< cells
};

/// Enters the boxes that entries(first, last, visit) visits for ranges of [0, count). Each thread
/// enters them in rows of its own. Returns false if all boxes together cover more cells than
/// `most`.
template <class Source>
bool enter_all(std::size_t count, std::size_t most, Cells& cells, const Run& run,
               const Source& entries) {
    if (run.threads <= 1) {
        std::size_t covered = 0;
        entries(std::size_t{0}, count, [&](const PackedBox& b, std::uint32_t group) {
            covered += cells.covered(b);
            if (covered <= most) cells.enter(b, group, 0, cells.row_count());
        });
        return covered <= most;
    }
    const auto parts =
        parts_of_ranges<Entries>(count, run, [&](std::size_t first, std::size_t last) {
            Entries part;
            entries(first, last, [&](const PackedBox& b, std::uint32_t group) {
                part.boxes.emplace_back(b, group);
                part.covered += cells.covered(b);
            });
            return part;
        });
    std::size_t covered = 0;
    for (const Entries& part : parts) covered += part.covered;
    if (covered > most) return false;
    constexpr std::size_t few = 8; // rows
    for_ranges(
        cells.row_count(), run,
        [&](std::size_t first, std::size_t last) {
            for (const Entries& part : parts)
                for (const auto& [box, group] : part.boxes) cells.enter(box, group, first, last);
        },
        1, few);
    return true;
}

/// Selects the boxes i that overlap region(i) and, if there are cells, a mixed cell.
template <class Region>
Selection select(const BoxSource& boxes, const Blocks& blocks, const Lattice& lattice,
                 const Cells* cells, const Region& region, const Run& run) {
    const auto of_blocks = [&](std::size_t first, std::size_t last) {
        Selection s;
        const auto test = [&](std::uint32_t i) {
            if (!boxes[i].overlaps(region(i))) return;
            const PackedBox b = lattice.pack(boxes[i]);
            if (cells != nullptr && !cells->meets_mixed(b)) return;
            s.boxes.push_back(b);
            s.indices.push_back(i);
        };
        for (auto k = static_cast<std::uint32_t>(first); k < last; ++k) {
            if (blocks.alike[k] != 0) {
                if (!blocks.boxes[k].overlaps(region(k * Blocks::size))) continue;
                const PackedBox b = lattice.pack(blocks.boxes[k]);
                if (cells != nullptr && cells->covered(b) <= 2 * most_cells &&
                    !cells->meets_mixed(b))
                    continue;
            }
            Blocks::for_each(k, boxes.size(), test);
        }
        return s;
    };
    auto parts = parts_of_ranges<Selection>(blocks.boxes.size(), run, of_blocks);
    Selection all = std::move(parts.front());
    for (std::size_t p = 1; p < parts.size(); ++p) {
        all.boxes.insert(all.boxes.end(), parts[p].boxes.begin(), parts[p].boxes.end());
        all.indices.insert(all.indices.end(), parts[p].indices.begin(), parts[p].indices.end());
    }
    return all;
}

} // namespace

Selection select_all(const BoxSource& boxes) {
    if (boxes.empty()) return {};
    Box all = empty_box;
    for (std::size_t i = 0; i < boxes.size(); ++i) extend(all, boxes[i]);
    const Lattice lattice(all);
    Selection s;
    s.boxes.resize(boxes.size());
    s.indices.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        s.boxes[i] = lattice.pack(boxes[i]);
        s.indices[i] = i;
    }
    return s;
}

Selection select_meeting(const BoxSource& boxes, std::span<const std::uint32_t> groups,
                         const Run& run) {
    const Blocks blocks(boxes, groups, run);
    const Regions regions(boxes, groups, blocks, run);
    if (is_empty(regions.any())) return {};
    const Lattice lattice(regions.any());
    Cells cells(boxes, lattice);
    const bool entered = enter_all(blocks.boxes.size(), most_covered(boxes.size()), cells, run,
                                   [&](std::size_t first, std::size_t last, const auto& visit) {
                                       for_entries(boxes, groups, blocks, regions, lattice, cells,
                                                   first, last, visit);
                                   });
    return select(
        boxes, blocks, lattice, entered ? &cells : nullptr,
        [&](std::uint32_t i) -> const Box& { return regions.of(groups[i]); }, run);
}

Selection select_near(const BoxSource& boxes, std::span<const std::uint32_t> active,
                      const Run& run) {
    if (active.empty()) return {};
    Box region = empty_box;
    for (const std::uint32_t i : active) extend(region, boxes[i]);
    const Lattice lattice(region);
    Cells cells(boxes, lattice);
    const bool entered =
        enter_all(active.size(), most_covered(boxes.size()), cells, run,
                  [&](std::size_t first, std::size_t last, const auto& visit) {
                      for (const std::uint32_t i : active.subspan(first, last - first))
                          visit(lattice.pack(boxes[i]), no_group);
                  });
    return select(
        boxes, Blocks(boxes, {}, run), lattice, entered ? &cells : nullptr,
        [&](std::uint32_t) -> const Box& { return region; }, run);
}

} // namespace terrane::search
