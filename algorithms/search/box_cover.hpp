// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Parts of space that consist of boxes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// Returns boxes that cover the given ones, and no more of them. Boxes that fill the box around them, as the
/// sum of their volumes is no less than its volume, are replaced by it. So the sum of the volumes does not
/// grow, and is less than that of the box around all unless one is left. Cost: n log² n.
std::vector<Box> united(std::vector<Box> boxes);

/// Answers questions about boxes at the cost of a walk down a tree, which ends at the first box found.
class BoxCover {
public:
    BoxCover() = default;
    explicit BoxCover(std::vector<Box> boxes);

    [[nodiscard]] const std::vector<Box>& boxes() const { return levels_.front(); }
    /// Tells whether one of the boxes overlaps this one. Adds how many were compared with it to `compared`.
    [[nodiscard]] bool overlaps(const Box& box, std::uint64_t& compared) const;
    /// Tells whether this one is within one of the boxes. Counts likewise.
    [[nodiscard]] bool contains(const Box& box, std::uint64_t& compared) const;

private:
    using Test = bool (*)(const Box& covered, const Box& box);
    bool any(const Box& box, Test test, std::size_t level, std::size_t at,
             std::uint64_t& compared) const;

    std::vector<std::vector<Box>> levels_{
        1}; ///< the boxes, then those around two of the level before
};

} // namespace terrane
