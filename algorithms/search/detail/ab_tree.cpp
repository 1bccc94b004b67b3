// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <numeric>
#include <utility>

#include <terrane/algorithms/search/methods.hpp>

namespace terrane::search {
namespace {

double key(const Box& b, unsigned level) {
    return level < 3 ? b.low[level] : b.high[level - 3];
}

/// The boxes sorted by one key. It finds the next box that is not taken yet.
class Sequence {
public:
    Sequence(std::span<const Box> boxes, unsigned level) :
        sorted_(boxes.size()), next_(boxes.size() + 1) {
        std::iota(sorted_.begin(), sorted_.end(), 0u);
        std::iota(next_.begin(), next_.end(), 0u);
        std::sort(sorted_.begin(), sorted_.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double ka = key(boxes[a], level), kb = key(boxes[b], level);
            return ka != kb ? ka < kb : a < b;
        });
    }

    /// Returns the first box at `position` or behind it that is not taken; boxes.size() if there is
    /// none.
    std::uint32_t left_from(std::uint32_t position, const std::vector<bool>& taken) {
        std::uint32_t at = position;
        while (at < sorted_.size() && taken[sorted_[at]])
            at = next_[at] = next_[at] > at ? next_[at] : at + 1;
        while (position < at) position = std::exchange(next_[position], at);
        return at < sorted_.size() ? sorted_[at] : at;
    }

private:
    std::vector<std::uint32_t> sorted_;
    std::vector<std::uint32_t> next_; ///< per position p: the boxes at [p, next_[p]) are taken
};

} // namespace

AbTree::AbTree(std::span<const Box> boxes, const std::stop_token& stop) {
    nodes_.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size() && !stop.stop_requested(); ++i) insert(boxes[i], i);
}

AbTree::AbTree(std::span<const Box> boxes, std::span<const std::uint32_t> order,
               const std::stop_token& stop) {
    nodes_.reserve(boxes.size());
    for (const std::uint32_t i : order) {
        if (stop.stop_requested()) return;
        insert(boxes[i], i);
    }
}

void AbTree::insert(const Box& box, std::uint32_t index) {
    const auto here = static_cast<std::uint32_t>(nodes_.size());
    unsigned level = 0;
    std::uint32_t* link = nullptr;
    for (std::uint32_t at = 0; at < here; at = *link) {
        Node& node = nodes_[at];
        link = key(box, node.level) < key(node.box, node.level) ? &node.left : &node.right;
        level = (node.level + 1) % 6;
        if (*link == 0) break;
    }
    if (link != nullptr) *link = here;
    nodes_.push_back({box, index, 0, 0, level});
}

void AbTree::divide_at_medians(std::span<const Box> boxes) {
    nodes_.clear();
    nodes_.reserve(boxes.size());
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0u);
    add_subtree(boxes, all, 0);
}

/// Adds the tree of a part of the boxes. Returns its root, or 0 if there are none.
std::uint32_t AbTree::add_subtree(std::span<const Box> boxes, std::span<std::uint32_t> part,
                                  unsigned level) {
    if (part.empty()) return 0;
    const std::size_t middle = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double ka = key(boxes[a], level), kb = key(boxes[b], level);
                         return ka != kb ? ka < kb : a < b;
                     });
    const auto here = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({boxes[part[middle]], part[middle], 0, 0, level});
    const std::uint32_t left = add_subtree(boxes, part.first(middle), (level + 1) % 6);
    const std::uint32_t right = add_subtree(boxes, part.subspan(middle + 1), (level + 1) % 6);
    nodes_[here].left = left;
    nodes_[here].right = right;
    return here;
}

std::size_t AbTree::depth() const {
    std::vector<std::uint32_t> depth(nodes_.size(), 1);
    std::uint32_t deepest = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        deepest = std::max(deepest, depth[n]);
        for (const std::uint32_t child : {nodes_[n].left, nodes_[n].right})
            if (child != 0) depth[child] = depth[n] + 1;
    }
    return deepest;
}

std::vector<std::uint32_t> table_1_order(std::span<const Box> boxes) {
    const std::size_t n = boxes.size();
    std::vector<Sequence> sequences;
    for (unsigned k = 0; k < 6; ++k) sequences.emplace_back(boxes, k);
    std::vector<std::uint32_t> order;
    std::vector<bool> taken(n);
    for (std::size_t t = 2, depth = 0; order.size() < n; t *= 2, ++depth)
        for (std::size_t j = 1; j < t; j += 2) {
            const auto quantile = static_cast<std::uint32_t>(j * n / t);
            const std::uint32_t i = sequences[depth % 6].left_from(quantile, taken);
            if (i == n) continue; // later depths reach the boxes before the quantile
            taken[i] = true;
            order.push_back(i);
        }
    return order;
}

} // namespace terrane::search
