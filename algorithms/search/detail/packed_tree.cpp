// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/detail/packed_tree.hpp>

#include <algorithm>
#include <bit>
#include <utility>

#include <terrane/algorithms/core/sort_by_key.hpp>

namespace terrane::search {
namespace {

std::uint32_t extent(const PackedBox& b, unsigned axis) {
    return b.high_of(axis) - b.low_of(axis);
}

/// Inserts two zeros before each of nine bits.
std::uint32_t spread(std::uint32_t x) {
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

/// A space-filling curve whose unit along each axis is the extent of the median box, so that the
/// curve fits the shape of the boxes.
class Curve {
public:
    explicit Curve(const Selection& s) {
        std::array<std::uint32_t, 3> extents{};
        unsigned finest = 0;
        for (unsigned k = 0; k < 3; ++k) {
            extents[k] = median_extent(s, k);
            shift_[k] = static_cast<unsigned>(std::bit_width(extents[k]));
            if (extents[k] > 0 && PackedBox::bits - shift_[k] > finest)
                finest = PackedBox::bits - shift_[k];
        }
        const unsigned coarser = finest > 9 ? finest - 9 : 0;
        for (unsigned k = 0; k < 3; ++k)
            shift_[k] = extents[k] == 0 ? PackedBox::bits - 9
                                        : std::min(PackedBox::bits, shift_[k] + coarser);
    }

    /// Returns the key of a box: its size class, then the interleaved bits of its centre.
    [[nodiscard]] std::uint32_t key(const PackedBox& b) const {
        std::uint32_t ratio = 0, bits = 0;
        for (unsigned k = 0; k < 3; ++k) {
            ratio |= extent(b, k) >> (shift_[k] + 1);
            const std::uint32_t centre = (b.low_of(k) + b.high_of(k)) / 2;
            bits |= spread(centre >> shift_[k]) << k;
        }
        return static_cast<std::uint32_t>(std::bit_width(ratio) + 1) / 2 << 27 | bits;
    }

private:
    static std::uint32_t median_extent(const Selection& s, unsigned axis) {
        std::vector<std::uint32_t> sample;
        if (s.boxes.empty()) return 0;
        const std::size_t step = s.boxes.size() / 1024 + 1;
        for (std::size_t i = 0; i < s.boxes.size(); i += step)
            sample.push_back(extent(s.boxes[i], axis));
        const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
        std::nth_element(sample.begin(), middle, sample.end());
        return *middle;
    }

    std::array<unsigned, 3> shift_{};
};

/// Returns the box of the first `count` of eight boxes.
PackedBox box_of(const EightBoxes& boxes, unsigned count) {
    std::array<std::uint64_t, 3> low{}, high{};
    low.fill(PackedBox::last);
    for (unsigned i = 0; i < count; ++i)
        for (unsigned k = 0; k < 3; ++k) {
            low[k] = std::min<std::uint64_t>(low[k], boxes[i].low_of(k));
            high[k] = std::max<std::uint64_t>(high[k], boxes[i].high_of(k));
        }
    return PackedBox::of(low, high);
}

/// Returns the bounding boxes of each eight of `count` boxes.
std::vector<EightBoxes> boxes_of_eight(std::span<const EightBoxes> boxes, std::size_t count) {
    std::vector<EightBoxes> level(boxes.size() / 8 + 1);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        level[i / 8].set(i % 8, box_of(boxes[i], static_cast<unsigned>(
                                                     std::min<std::size_t>(8, count - 8 * i))));
    return level;
}

} // namespace

PackedTree::PackedTree(const Selection& selection, std::span<const std::uint32_t> crowd_of) {
    const std::size_t n = selection.boxes.size();
    const Curve curve(selection);
    std::vector<Keyed> order(n), scratch;
    for (std::uint32_t i = 0; i < n; ++i) order[i] = {curve.key(selection.boxes[i]), i};
    sort_by_key(order, scratch);
    if (!crowd_of.empty()) {
        for (Keyed& k : order) k.key = crowd_of[selection.indices[k.position]];
        sort_by_key(order, scratch);
    }
    indices_.reserve(n);
    auto& boxes = levels_.emplace_back((n + 7) / 8);
    for (std::size_t i = 0; i < n; ++i) {
        boxes[i / 8].set(i % 8, selection.boxes[order[i].position]);
        indices_.push_back(selection.indices[order[i].position]);
    }
    leaves_ = static_cast<std::uint32_t>(boxes.size());
    std::size_t count = n;
    do {
        levels_.push_back(boxes_of_eight(levels_.back(), count));
        count = (count + 7) / 8;
    } while (count > 8);
    if (!crowd_of.empty()) find_crowds(crowd_of);
}

void PackedTree::find_crowds(std::span<const std::uint32_t> crowd_of) {
    std::vector<std::uint32_t> below(indices_.size());
    for (std::size_t i = 0; i < below.size(); ++i) below[i] = crowd_of[indices_[i]];
    for (const auto& level : levels_) {
        std::vector<std::uint32_t> here(level.size(), no_group);
        for (std::size_t e = 0; 8 * e < below.size(); ++e) {
            const auto children =
                std::span(below).subspan(8 * e, std::min<std::size_t>(8, below.size() - 8 * e));
            const auto is_first = [&](std::uint32_t c) { return c == children.front(); };
            if (std::all_of(children.begin(), children.end(), is_first)) here[e] = children.front();
        }
        below = here;
        crowds_.push_back(std::move(here));
    }
}

} // namespace terrane::search
