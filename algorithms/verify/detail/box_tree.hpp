// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Boxes of the verifier, by which it skips pairs that cannot meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>
#include <terrane/algorithms/verify/detail/violations.hpp>

namespace terrane::verifier {

/// Tells whether two boxes have a point in common.
bool touch(const Box& a, const Box& b);
/// Enlarges a box to contain another one.
void extend(Box& box, const Box& other);
/// Enlarges a box by a distance on all sides, or a little more.
Box widened_by(Box box, double distance);

Box box_of(const Point3& point);
/// Returns the box around the corners of a triangle.
Box box_of(std::span<const Point3> points, const Triangle& triangle);
/// Precondition: all points have w = 1.
Box box_of(std::span<const Vector4> points, const Triangle& triangle);

/// A tree of boxes over some items: the box of a node contains the boxes of all items below it.
class BoxTree {
public:
    BoxTree() = default;
    /// Item i has box boxes[i], and belongs to the group groups[i] if there are any. A group, which may be no_number,
    /// has a subtree of its own.
    BoxTree(std::vector<Box> boxes, std::vector<std::uint32_t> items,
            std::vector<std::uint32_t> groups = {});
    /// All boxes are items.
    explicit BoxTree(std::vector<Box> boxes);

    /// Returns the items whose boxes touch a box, sorted; except those of a group, unless that is no_number.
    [[nodiscard]] std::vector<std::uint32_t> touching(const Box& box,
                                                      std::uint32_t but = no_number) const;

    /// Does the same for the box and the group of an item.
    [[nodiscard]] std::vector<std::uint32_t> touching_others(std::uint32_t item) const;

private:
    /// A node of the tree. Nodes are in depth-first order: the first child of a node follows it.
    struct Node {
        Box box;
        std::size_t first = 0; ///< of a leaf: its items are items_[first, last)
        std::size_t last = 0;
        std::size_t after = 0;           ///< the node that follows the whole subtree
        std::uint32_t group = no_number; ///< of all items below it
    };
    static constexpr std::size_t leaf_size = 4;

    [[nodiscard]] std::uint32_t group_of(std::size_t position) const;
    void build(std::size_t first, std::size_t last);
    std::size_t split(std::size_t first, std::size_t last, const Box& box);

    std::vector<Box> boxes_;
    std::vector<std::uint32_t> items_; ///< by groups
    std::vector<std::uint32_t> groups_;
    std::vector<Node> nodes_;
};

} // namespace terrane::verifier
