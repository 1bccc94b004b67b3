// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A bounding volume hierarchy without pointers: boxes in the order of a space-filling curve, eight
// neighbours to a node.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/search/detail/cell_culling.hpp>

namespace terrane::search {

/// Boxes of similar size come together in the order, so a few large ones do not blow up the nodes
/// of many small ones. Cost: sorting 32-bit keys by digits, then linear.
class PackedTree {
public:
    PackedTree() = default; ///< of nothing; not to be joined
    explicit PackedTree(const Selection& selection);

    /// Number of leaves of eight boxes.
    [[nodiscard]] std::uint32_t leaf_count() const { return leaves_; }

    /// Calls report(index here, index there, inside) for all boxes of a leaf here and of the other
    /// tree, packed on the same lattice, that overlap; each pair once. inside: their boxes surely
    /// overlap, not only as packed. Of pairs within one tree, whatever the order, only those that
    /// no smaller leaf reports.
    template <class Report>
    void join(std::uint32_t leaf, const PackedTree& other, const Report& report) const {
        struct Node {
            std::uint32_t level, number; ///< levels_[level][number]
        };
        const PackedBox box = box_of_leaf(leaf);
        const std::uint32_t from = &other == this ? leaf : 0;
        std::array<Node, 8 * levels_at_most> stack; // NOLINT: filled as far as used
        unsigned top = 0;
        stack[top++] = {static_cast<std::uint32_t>(other.levels_.size()) - 1, 0};
        while (top > 0) {
            const Node node = stack[--top];
            unsigned meeting = other.levels_[node.level][node.number].overlapping(box);
            for (; meeting != 0; meeting &= meeting - 1) {
                const std::uint32_t child = 8 * node.number + lowest(meeting);
                if ((std::uint64_t{child} + 1) << (3 * (node.level - 1)) <= from) continue;
                if (node.level == 1)
                    join_leaves(leaf, other, child, report);
                else
                    stack[top++] = {node.level - 1, child};
            }
        }
    }

private:
    static constexpr unsigned levels_at_most = 12; // 8^11 > 2^32

    static unsigned lowest(unsigned mask) { return static_cast<unsigned>(std::countr_zero(mask)); }

    [[nodiscard]] PackedBox box_of_leaf(std::uint32_t leaf) const {
        return levels_[1][leaf / 8][leaf % 8];
    }

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

    std::vector<std::vector<EightBoxes>> levels_; ///< the boxes, then boxes of each eight of the
                                                  ///< level before (once at least), up to one eight
    std::vector<std::uint32_t> indices_;          ///< per box of levels_[0]
    std::uint32_t leaves_ = 0;
};

} // namespace terrane::search
