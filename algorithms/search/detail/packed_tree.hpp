// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Implements a bounding volume hierarchy without pointers: boxes are in the order of a
// space-filling curve, with eight neighbours per node.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/search/detail/cell_culling.hpp>

namespace terrane::search {

/// A tree of packed boxes. The order groups boxes of similar size, so that a few large boxes do not
/// enlarge the nodes of many small ones. Boxes of one crowd stand together, so that whole nodes of
/// them are left out at once. Cost: linear (radix sort of 32-bit keys, one pass per level).
class PackedTree {
public:
    PackedTree() = default; ///< an empty tree, which must not be joined
    /// crowd_of: per box of the list that the selection is from, its crowd or no_group; or empty.
    explicit PackedTree(const Selection& selection, std::span<const std::uint32_t> crowd_of = {});

    /// Returns the number of leaves of eight boxes.
    [[nodiscard]] std::uint32_t leaf_count() const { return leaves_; }
    /// Returns the indices of all boxes, those of a leaf together.
    [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_; }
    /// Returns the indices of the boxes of a leaf.
    [[nodiscard]] std::span<const std::uint32_t> indices_of(std::uint32_t leaf) const {
        const std::size_t first = std::size_t{8} * leaf;
        return std::span(indices_).subspan(first,
                                           std::min<std::size_t>(8, indices_.size() - first));
    }

    /// Calls report(index here, index there, inside) once for each pair of overlapping packed
    /// boxes, one in a leaf of this tree and one in the other tree. Both trees must be packed on
    /// the same lattice. `inside` says that the original boxes certainly overlap, too. If both
    /// trees are the same object, a leaf reports only the pairs that no leaf with a smaller number
    /// reports. Most pairs within one crowd are left out, but not all. A report that has is_full()
    /// ends the search of the leaf when that is true.
    template <class Report>
    void join(std::uint32_t leaf, const PackedTree& other, const Report& report) const {
        struct Node {
            std::uint32_t level, number; ///< levels_[level][number]
        };
        const PackedBox box = box_of_leaf(leaf);
        const std::uint32_t from = &other == this ? leaf : 0;
        const std::uint32_t crowd = crowd_of(0, leaf);
        std::array<Node, 8 * levels_at_most> stack; // NOLINT: filled as far as used
        unsigned top = 0;
        stack[top++] = {static_cast<std::uint32_t>(other.levels_.size()) - 1, 0};
        while (top > 0) {
            const Node node = stack[--top];
            unsigned meeting = other.levels_[node.level][node.number].overlapping(box);
            for (; meeting != 0; meeting &= meeting - 1) {
                const std::uint32_t child = 8 * node.number + lowest(meeting);
                if ((std::uint64_t{child} + 1) << (3 * (node.level - 1)) <= from) continue;
                if (crowd != no_group && other.crowd_of(node.level - 1, child) == crowd) continue;
                if (node.level > 1) {
                    stack[top++] = {node.level - 1, child};
                    continue;
                }
                join_leaves(leaf, other, child, report);
                if constexpr (requires { report.is_full(); })
                    if (report.is_full()) return;
            }
        }
    }

private:
    static constexpr unsigned levels_at_most = 12; // 8^11 > 2^32

    static unsigned lowest(unsigned mask) { return static_cast<unsigned>(std::countr_zero(mask)); }

    [[nodiscard]] PackedBox box_of_leaf(std::uint32_t leaf) const {
        return levels_[1][leaf / 8][leaf % 8];
    }

    /// Returns the crowd of all boxes below eight `number` of a level, or no_group.
    [[nodiscard]] std::uint32_t crowd_of(std::uint32_t level, std::uint32_t number) const {
        return crowds_.empty() ? no_group : crowds_[level][number];
    }

    void find_crowds(std::span<const std::uint32_t> crowd_of);

    template <class Report>
    void join_leaves(std::uint32_t leaf, const PackedTree& other, std::uint32_t other_leaf,
                     const Report& report) const {
        const EightBoxes &here = levels_[0][leaf], &there = other.levels_[0][other_leaf];
        const bool same = &here == &there;
        for (unsigned a = here.overlapping(other.box_of_leaf(other_leaf)); a != 0; a &= a - 1) {
            const unsigned i = lowest(a);
            const PackedBox box = here[i];
            for (unsigned b = there.overlapping(box) & (same ? ~1u << i : ~0u); b != 0;
                 b &= b - 1) {
                const unsigned j = lowest(b);
                report(indices_[8 * leaf + i], other.indices_[8 * other_leaf + j],
                       box.overlaps_inside(there[j]));
            }
        }
    }

    std::vector<std::vector<EightBoxes>> levels_; ///< level 0: the boxes; level k >= 1: bounding
                                                  ///< boxes of each eight of level k - 1; the last
                                                  ///< level is one eight
    std::vector<std::uint32_t> indices_;          ///< per box of levels_[0]
    std::vector<std::vector<std::uint32_t>> crowds_; ///< as levels_: see crowd_of(); or empty
    std::uint32_t leaves_ = 0;
};

} // namespace terrane::search
