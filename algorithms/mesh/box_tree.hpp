// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// Finds the boxes near a point, in floating point, by a tree of boxes that is split at medians.
class BoxTree {
public:
    struct Box {
        Point3 low, high; ///< low > high: empty, and near nothing
    };
    /// Cost: O(n log n).
    explicit BoxTree(std::vector<Box> boxes);

    /// Returns the numbers of the boxes nearer to p than `bound`, ascending. Cost: about O(log n), and
    /// the number of these boxes.
    [[nodiscard]] std::vector<std::uint32_t> within(const Point3& p, double bound) const;

private:
    struct Node {
        Box box;
        std::uint32_t first, last;  ///< in order_
        std::uint32_t children = 0; ///< the first of two; 0: a leaf
    };
    void add_node(std::uint32_t first, std::uint32_t last);

    std::vector<Box> boxes_;
    std::vector<std::uint32_t> order_; ///< boxes that are not empty, in the order of the leaves
    std::vector<Node> nodes_;
};

} // namespace terrane
