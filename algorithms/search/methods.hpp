// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The searches of the paper. One concept: built from boxes, a search reports all boxes that overlap
// a query box, in any order, each once.
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
    void query(const Box& q, const Report& report) {
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

    /// Number of boxes in the cells that a query looks in.
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

/// Paper 2.2: a binary tree over v = (low x, low y, low z, high x, high y, high z). A node of depth
/// j has the boxes with smaller v[j mod 6] on its left, the others on its right. Boxes are inserted
/// one by one at the first free place, so the order decides the shape: a list in the worst case,
/// with quadratic cost.
class AbTree {
public:
    AbTree() = default;
    /// In the order of the boxes.
    explicit AbTree(std::span<const Box> boxes);
    AbTree(std::span<const Box> boxes, std::span<const std::uint32_t> order);

    void insert(const Box& box, std::uint32_t index);

    template <class Report>
    void query(const Box& q, const Report& report) {
        if (!nodes_.empty()) stack_.push_back(0);
        while (!stack_.empty()) {
            const Node& node = nodes_[stack_.back()];
            stack_.pop_back();
            if (node.box.overlaps(q)) report(node.index);
            const unsigned axis = node.level % 3;
            const bool splits_low = node.level < 3;
            const double key = splits_low ? node.box.low[axis] : node.box.high[axis];
            // Right of a low key all start at or behind it; left of a high key all end before it.
            if (node.right != 0 && (!splits_low || key <= q.high[axis]))
                stack_.push_back(node.right);
            if (node.left != 0 && (splits_low || key >= q.low[axis])) stack_.push_back(node.left);
        }
    }

    /// Number of levels.
    [[nodiscard]] std::size_t depth() const;

private:
    struct Node {
        Box box;
        std::uint32_t index;
        std::uint32_t left = 0, right = 0; ///< nodes; 0, the root, for none
        std::uint32_t level = 0;           ///< depth mod 6
    };

    std::vector<Node> nodes_;          ///< in the order of insertion; a child follows its parent
    std::vector<std::uint32_t> stack_; ///< of the query; as deep as the tree may be
};

/// The insertion order of Table 1: at depth i the quantiles j / 2^(i+1), j odd, of the boxes sorted
/// by v[i mod 6]; where a box has its place already, the next one that has none.
std::vector<std::uint32_t> table_1_order(std::span<const Box> boxes);

/// Paper 2.2, balanced. Depth about twice the least on surfaces; where many boxes share all their
/// keys a list again.
class BalancedAbTree : public AbTree {
public:
    explicit BalancedAbTree(std::span<const Box> boxes) : AbTree(boxes, table_1_order(boxes)) {}
};

/// Paper 2.3, the reduction: the boxes that have one of another group in the cells of one grid over
/// all, that is in those a query would look in; ascending. Without groups, all.
std::vector<std::uint32_t> boxes_in_mixed_cells(std::span<const Box> boxes,
                                                std::span<const std::uint32_t> groups);

} // namespace terrane::search
