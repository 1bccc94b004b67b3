// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Extents of surfaces from which those near a given one are taken out, until none is left.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/plausibility/detail/extents.hpp>

namespace terrane::plausibility::detail {

/// Tells whether the gap between two extents, from above, is at most `far` diagonals of the larger.
inline bool are_near(const Extent& a, const Extent& b, double far) {
    return gap_from_above(a, b) <= far * std::max(a.diagonal(), b.diagonal());
}

/// A tree of extents for each power of two of their diagonals. So how near counts as near is about the
/// same for all extents of a tree, and a node with none near is passed over as a whole. Cost: O(n log n)
/// for all, where extents that are nearly near are few.
class LeftExtents {
public:
    /// Holds the extents with these numbers; they must outlive it.
    LeftExtents(std::span<const Extent> extents, std::span<const std::uint32_t> numbers);

    /// Takes out the extents near to `here`, and appends their numbers in no stated order.
    void take_near(const Extent& here, double far, std::vector<std::uint32_t>& taken);
    [[nodiscard]] bool holds(std::uint32_t number) const { return left_[number]; }
    /// Returns the number of nodes that were looked at: a measure of the cost.
    [[nodiscard]] std::size_t visits() const { return visits_; }

private:
    struct Node {
        Extent all{};                      ///< of the extents in it that are left
        double diagonal = 0;               ///< the largest of them
        std::uint32_t first = 0, last = 0; ///< in order_
        std::uint32_t children = 0;        ///< the first of two; 0: a leaf
        [[nodiscard]] bool empty() const { return all.empty(); }
    };

    void build(std::uint32_t node);
    void gather(Node& node) const;
    void take(std::uint32_t node, const Extent& here, double far,
              std::vector<std::uint32_t>& taken);

    std::span<const Extent> extents_;
    std::vector<std::uint32_t> order_; ///< numbers, in the order of the leaves
    std::vector<bool> left_;           ///< per extent
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> roots_; ///< one per power of two
    std::size_t visits_ = 0;
};

} // namespace terrane::plausibility::detail
