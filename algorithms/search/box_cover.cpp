// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/box_cover.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

namespace terrane {

namespace {

void extend(Box& box, const Box& by) {
    for (unsigned k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], by.low[k]);
        box.high[k] = std::max(box.high[k], by.high[k]);
    }
}

Box box_around(std::span<const Box> boxes) {
    Box around = boxes.front();
    for (const Box& box : boxes) extend(around, box);
    return around;
}

/// Returns half of the length of a side, which is finite where all coordinates are.
double half_side(const Box& box, unsigned k) {
    return box.high[k] / 2 - box.low[k] / 2;
}

bool is_within(const Box& outer, const Box& inner) {
    for (unsigned k = 0; k < 3; ++k)
        if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
    return true;
}

/// Unites boxes from the leaves of a tree upwards, each inner node of which halves them.
class Union {
public:
    explicit Union(std::span<Box> boxes) : all_(box_around(boxes)) { add(boxes); }

    [[nodiscard]] std::vector<Box> take() { return std::move(united_); }

private:
    void add(std::span<Box> boxes) {
        if (boxes.size() == 1) return united_.push_back(boxes.front());
        halve(boxes);
        const std::size_t first = united_.size(), half = boxes.size() / 2;
        add(boxes.first(half));
        add(boxes.subspan(half));
        const Box around = box_around(std::span(united_).subspan(first));
        double sum = 0;
        bool is_one = false; // it is one of them, whatever its volume
        for (std::size_t k = first; k < united_.size(); ++k) {
            sum += volume(united_[k]);
            is_one |= is_within(united_[k], around);
        }
        if (!is_one && !(sum > 0 && sum >= volume(around))) return;
        united_.resize(first);
        united_.push_back(around);
    }

    /// Puts those with the lower centres along the longest side first.
    void halve(std::span<Box> boxes) const {
        const Box around = box_around(boxes);
        unsigned longest = 0;
        for (unsigned k = 1; k < 3; ++k)
            if (half_side(around, k) > half_side(around, longest)) longest = k;
        const auto centre = [&](const Box& b) { return b.low[longest] / 2 + b.high[longest] / 2; };
        std::nth_element(
            boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(boxes.size() / 2),
            boxes.end(), [&](const Box& a, const Box& b) {
                return std::tuple(centre(a), a.low, a.high) < std::tuple(centre(b), b.low, b.high);
            });
    }

    /// Returns the share of the volume around all.
    [[nodiscard]] double volume(const Box& box) const {
        double share = 1;
        for (unsigned k = 0; k < 3; ++k)
            if (half_side(all_, k) > 0) share *= half_side(box, k) / half_side(all_, k);
        return share;
    }

    const Box all_;
    std::vector<Box> united_;
};

} // namespace

std::vector<Box> united(std::vector<Box> boxes) {
    return boxes.empty() ? boxes : Union(boxes).take();
}

BoxCover::BoxCover(std::vector<Box> boxes) {
    for (levels_[0] = std::move(boxes); levels_.back().size() > 1;) {
        const std::vector<Box>& below = levels_.back();
        std::vector<Box> level;
        for (std::size_t k = 0; k < below.size(); k += 2)
            level.push_back(box_around(
                std::span(below).subspan(k, std::min<std::size_t>(2, below.size() - k))));
        levels_.push_back(std::move(level));
    }
}

bool BoxCover::any(const Box& box, Test test, std::size_t level, std::size_t at,
                   std::uint64_t& compared) const {
    if (at >= levels_[level].size()) return false;
    ++compared;
    if (!test(levels_[level][at], box)) return false;
    return level == 0 || any(box, test, level - 1, 2 * at, compared) ||
           any(box, test, level - 1, 2 * at + 1, compared);
}

bool BoxCover::overlaps(const Box& box, std::uint64_t& compared) const {
    const Test test = [](const Box& covered, const Box& b) { return covered.overlaps(b); };
    return any(box, test, levels_.size() - 1, 0, compared);
}

bool BoxCover::contains(const Box& box, std::uint64_t& compared) const {
    return any(box, is_within, levels_.size() - 1, 0, compared);
}

} // namespace terrane
