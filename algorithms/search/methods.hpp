// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Implements the searches of the paper. All model one concept: a search is built from boxes, and
// its query reports every box that overlaps a query box once, in any order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include <terrane/algorithms/search/search.hpp>

namespace terrane::search {

/// Tests every box.
class Brute {
public:
    explicit Brute(std::span<const Box> boxes) : boxes_(boxes) {}

    template <class Report>
    void query(const Box& q, const Report& report) {
        for (std::uint32_t i = 0; i < boxes_.size(); ++i)
            if (boxes_[i].overlaps(q)) report(i);
    }

private:
    std::span<const Box> boxes_;
};

/// Queries of CellGrid are widened by half of the largest box, by grid_width_share of that, and by
/// grid_size_share of the largest coordinate. kernel/proofs/grid_widening.g is a proof that Gappa checks
/// with these numbers.
inline constexpr double grid_width_share = 0x1p-40, grid_size_share = 0x1p-50;

/// The structured search of paper 2.1. Cells are at least as large as the largest box (equation 3),
/// and each box is stored in the cell of its centre (7, 8). A query visits all cells that the query
/// box overlaps after widening by half the largest box. This finds every overlapping box: its
/// centre is at most half its own size away from the query box.
class CellGrid {
public:
    explicit CellGrid(std::span<const Box> boxes);

    template <class Report>
    void query(const Box& q, const Report& report) const {
        for_rows(q, [&](std::size_t first, std::size_t last) {
            for (std::uint32_t i = starts_[first]; i < starts_[last + 1]; ++i)
                if (stored_[i].box.overlaps(q)) report(stored_[i].index);
        });
    }

    /// Returns the number of boxes in the cells that a query visits.
    [[nodiscard]] std::size_t looked_at(const Box& q) const {
        std::size_t count = 0;
        for_rows(q, [&](std::size_t first, std::size_t last) {
            count += starts_[last + 1] - starts_[first];
        });
        return count;
    }

    [[nodiscard]] std::size_t cell_count() const { return starts_.size() - 1; }
    [[nodiscard]] std::size_t cell_of(const Box& b) const;

    /// Calls visit(first, last) for each row of cells that the widened box overlaps.
    template <class Visit>
    void for_rows(const Box& q, const Visit& visit) const {
        std::array<std::uint32_t, 3> from{}, to{};
        for (unsigned k = 0; k < 3; ++k) {
            from[k] = cell(k, q.low[k] - widening_[k]);
            to[k] = cell(k, q.high[k] + widening_[k]);
        }
        for (std::uint32_t z = from[2]; z <= to[2]; ++z)
            for (std::uint32_t y = from[1]; y <= to[1]; ++y) {
                const std::size_t row = (std::size_t{z} * counts_[1] + y) * counts_[0];
                visit(row + from[0], row + to[0]);
            }
    }

private:
    struct Stored {
        Box box;
        std::uint32_t index;
    };

    void choose_cells(std::span<const Box> boxes);
    [[nodiscard]] std::uint32_t cell(unsigned axis, double x) const;

    std::array<double, 3> origin_{}, size_{1, 1, 1}, widening_{};
    std::array<std::uint32_t, 3> counts_{1, 1, 1};
    std::vector<std::uint32_t> starts_; ///< per cell, and one past the last: range in stored_
    std::vector<Stored> stored_;        ///< by cell
};

/// The alternating binary tree of paper 2.2 over v = (low x, low y, low z, high x, high y, high z).
/// The left subtree of a node of depth j has the boxes with smaller v[j mod 6], the right subtree
/// the others. Boxes are inserted one by one at the first free node, so their order determines the
/// shape: in the worst case a list, with quadratic cost.
class AbTree {
public:
    AbTree() = default;
    /// Inserts the boxes in their order, until a stop is requested.
    explicit AbTree(std::span<const Box> boxes, const std::stop_token& stop = {});
    /// Inserts the boxes in the order of the given indices, until a stop is requested.
    AbTree(std::span<const Box> boxes, std::span<const std::uint32_t> order,
           const std::stop_token& stop = {});

    void insert(const Box& box, std::uint32_t index);

    template <class Report>
    void query(const Box& q, const Report& report) {
        walk(q, [&](const Node& node) {
            if (node.box.overlaps(q)) report(node.index);
        });
    }

    /// Returns the number of boxes that a query tests.
    [[nodiscard]] std::size_t looked_at(const Box& q) {
        std::size_t count = 0;
        walk(q, [&](const Node&) { ++count; });
        return count;
    }

    /// Returns the number of levels.
    [[nodiscard]] std::size_t depth() const;

protected:
    /// Makes the tree of all boxes anew: each subtree is divided at the median of its own boxes by
    /// the key of its level. Boxes with the same key are divided by their indices, so they may be
    /// on both sides of a node; queries allow for that.
    void divide_at_medians(std::span<const Box> boxes);

private:
    struct Node {
        Box box;
        std::uint32_t index;
        std::uint32_t left = 0, right = 0; ///< nodes; 0, the root, for none
        std::uint32_t level = 0;           ///< depth mod 6
    };

    std::uint32_t add_subtree(std::span<const Box> boxes, std::span<std::uint32_t> part,
                              unsigned level);

    /// Visits the nodes whose boxes a query must test.
    template <class Visit>
    void walk(const Box& q, const Visit& visit) {
        if (!nodes_.empty()) stack_.push_back(0);
        while (!stack_.empty()) {
            const Node& node = nodes_[stack_.back()];
            stack_.pop_back();
            visit(node);
            const unsigned axis = node.level % 3;
            const bool splits_low = node.level < 3;
            const double key = splits_low ? node.box.low[axis] : node.box.high[axis];
            // Boxes in the right subtree of a low key start at it or behind it; boxes in the left
            // subtree of a high key end before it.
            if (node.right != 0 && (!splits_low || key <= q.high[axis]))
                stack_.push_back(node.right);
            if (node.left != 0 && (splits_low || key >= q.low[axis])) stack_.push_back(node.left);
        }
    }

    std::vector<Node> nodes_;          ///< a child follows its parent
    std::vector<std::uint32_t> stack_; ///< nodes that the current query has yet to visit
};

/// Returns the insertion order of Table 1. At depth i it takes the quantiles j / 2^(i+1), j odd, of
/// the boxes sorted by v[i mod 6]; for a box that is taken already, the next one that is not.
std::vector<std::uint32_t> table_1_order(std::span<const Box> boxes);

/// The balanced tree of paper 2.2, where Table 1 is taken for an order of insertion. On surfaces it
/// is about twice as deep as the shallowest tree. If many boxes share all their keys, it
/// degenerates to a list, too.
class BalancedAbTree : public AbTree {
public:
    explicit BalancedAbTree(std::span<const Box> boxes, const std::stop_token& stop = {}) :
        AbTree(boxes, table_1_order(boxes), stop) {}
};

/// The balanced tree of paper 2.2, where the quantiles of Table 1 are those of each subtree: a node
/// is the median of the boxes below it by the key of its level. No tree is shallower, whatever the
/// boxes. Cost: O(n log n).
class MedianAbTree : public AbTree {
public:
    explicit MedianAbTree(std::span<const Box> boxes) { divide_at_medians(boxes); }
};

/// Performs the reduction of paper 2.3: in one grid over all boxes it returns those with a box of
/// another group in the cells that their query would visit; ascending. Without groups it returns
/// all boxes.
std::vector<std::uint32_t> boxes_in_mixed_cells(std::span<const Box> boxes,
                                                std::span<const std::uint32_t> groups);

} // namespace terrane::search
