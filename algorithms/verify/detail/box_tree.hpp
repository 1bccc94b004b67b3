// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Boxes of the verifier, by which it skips pairs that cannot meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// Tells whether two boxes have a point in common.
bool touch(const Box& a, const Box& b);
/// Enlarges a box to contain another one.
void extend(Box& box, const Box& other);

/// A tree of boxes over some items: the box of a node contains the boxes of all items below it.
class BoxTree {
public:
    /// Item i has box boxes[i].
    BoxTree(std::vector<Box> boxes, std::vector<std::uint32_t> items) :
        boxes_(std::move(boxes)), items_(std::move(items)) {
        if (!items_.empty()) build(0, items_.size());
    }

    /// Returns the items whose boxes touch a box, sorted.
    [[nodiscard]] std::vector<std::uint32_t> touching(const Box& box) const;

    /// Returns the items larger than `item` whose boxes touch its box, sorted.
    [[nodiscard]] std::vector<std::uint32_t> touching_above(std::uint32_t item) const;

private:
    /// A node of the tree. Nodes are in depth-first order: the first child of a node follows it.
    struct Node {
        Box box;
        std::size_t first = 0; ///< of a leaf: its items are items_[first, last)
        std::size_t last = 0;
        std::size_t after = 0; ///< the node that follows the whole subtree
    };
    static constexpr std::size_t leaf_size = 4;

    template <class Take>
    void for_each_touching(const Box& box, const Take& take) const;
    void build(std::size_t first, std::size_t last);
    std::size_t split(std::size_t first, std::size_t last, const Box& box);

    std::vector<Box> boxes_;
    std::vector<std::uint32_t> items_;
    std::vector<Node> nodes_;
};

} // namespace terrane::verifier
