// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The concept that every search models: built from boxes, it reports all boxes that overlap a
// query box, in any order, each once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/search/search.hpp>

namespace terrane::search {

/// Every box is tested.
class Brute {
public:
    explicit Brute(std::span<const Box> boxes) : boxes_(boxes) {}

    template <class Report>
    void query(const Box& q, const Report& report) const {
        for (std::uint32_t i = 0; i < boxes_.size(); ++i)
            if (boxes_[i].overlaps(q)) report(i);
    }

private:
    std::span<const Box> boxes_;
};

/// Paper 2.1: cells as large as the largest box (equation 3), each box stored in the one cell of
/// its centre (7, 8). A query looks in all cells that the query box, widened by half a cell,
/// overlaps: a box that overlaps the query box has its centre no farther from it than half its own
/// size, and no box is larger than a cell.
class Grid {
public:
    explicit Grid(std::span<const Box> boxes);

    template <class Report>
    void query(const Box& q, const Report& report) const {
        std::array<std::uint32_t, 3> from{}, to{};
        for (unsigned k = 0; k < 3; ++k) {
            from[k] = cell(k, q.low[k] - widening_[k]);
            to[k] = cell(k, q.high[k] + widening_[k]);
        }
        for (std::uint32_t z = from[2]; z <= to[2]; ++z)
            for (std::uint32_t y = from[1]; y <= to[1]; ++y) {
                const std::size_t row = (std::size_t{z} * counts_[1] + y) * counts_[0];
                for (std::uint32_t i = starts_[row + from[0]]; i < starts_[row + to[0] + 1]; ++i)
                    if (stored_[i].box.overlaps(q)) report(stored_[i].index);
            }
    }

private:
    struct Stored {
        Box box;
        std::uint32_t index;
    };

    [[nodiscard]] std::uint32_t cell(unsigned axis, double x) const;
    [[nodiscard]] std::size_t cell_of(const Box& b) const;

    std::array<double, 3> origin_{}, size_{1, 1, 1}, widening_{};
    std::array<std::uint32_t, 3> counts_{1, 1, 1};
    std::vector<std::uint32_t> starts_; ///< per cell, and one past the last: range in stored_
    std::vector<Stored> stored_;        ///< by cell
};

/// Paper 2.2, Table 1: a binary tree over v = (low x, low y, low z, high x, high y, high z), level
/// j split at the median of v[j mod 6]. Implicit in one array: the subtree of [first, last) has its
/// root at the middle, the left part before it, the right one behind.
class AbTree {
public:
    explicit AbTree(std::span<const Box> boxes);

    template <class Report>
    void query(const Box& q, const Report& report) const {
        struct Range {
            std::uint32_t first, last;
            unsigned level;
        };
        std::array<Range, 64> stack; // NOLINT: filled as far as used
        unsigned top = 0;
        stack[top++] = {0, static_cast<std::uint32_t>(nodes_.size()), 0};
        while (top > 0) {
            const Range r = stack[--top];
            if (r.first >= r.last) continue;
            const std::uint32_t middle = r.first + (r.last - r.first) / 2;
            const Node& node = nodes_[middle];
            if (node.box.overlaps(q)) report(node.index);
            const unsigned axis = r.level % 3, next = (r.level + 1) % 6;
            const bool splits_low = r.level < 3;
            const double key = splits_low ? node.box.low[axis] : node.box.high[axis];
            // Right of a low key all start at or behind it; left of a high key all end before it.
            if (!splits_low || key <= q.high[axis]) stack[top++] = {middle + 1, r.last, next};
            if (splits_low || key >= q.low[axis]) stack[top++] = {r.first, middle, next};
        }
    }

private:
    struct Node {
        Box box;
        std::uint32_t index;
    };

    void build(std::uint32_t first, std::uint32_t last, unsigned level);

    std::vector<Node> nodes_;
};

/// A bounding volume hierarchy: ranges of boxes halved at the median of their centres along the
/// axis on which these are spread most, down to a few boxes.
class Hierarchy {
public:
    explicit Hierarchy(std::span<const Box> boxes);

    template <class Report>
    void query(const Box& q, const Report& report) const {
        if (nodes_.empty()) return;
        std::array<std::uint32_t, 64> stack; // NOLINT: filled as far as used
        unsigned top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            if (!node.box.overlaps(q)) continue;
            if (node.second_child != 0) {
                stack[top++] = node.second_child;
                stack[top++] = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.last; ++i)
                if (stored_[i].box.overlaps(q)) report(stored_[i].index);
        }
    }

private:
    static constexpr std::uint32_t leaf_size = 6;

    struct Node {
        Box box;
        std::uint32_t first, last;  ///< range of stored_
        std::uint32_t second_child; ///< 0: a leaf; the first child follows its parent
    };
    struct Stored {
        Box box;
        std::uint32_t index;
    };

    void build(std::uint32_t first, std::uint32_t last);

    std::vector<Node> nodes_;
    std::vector<Stored> stored_;
};

} // namespace terrane::search
