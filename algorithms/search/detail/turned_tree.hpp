// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Implements a bounding volume hierarchy of boxes that are turned along their triangles. Long thin triangles
// that run along no axis have axis-aligned boxes that nearly all overlap; their turned boxes are as thin as they.
//
// A pair is left out only if it is certainly apart, at such a distance that the points of both triangles may be
// rounded to the nearest doubles: by law (1) of SeparationFilter, or by the following statements. Coordinates are
// those of a UnitMap: within 1/2 of 0, each with an error of at most 2^-51. Rounding may be in any mode.
// (1) The axes a_0, a_1, a_2 of a box are rows of a matrix A with |A A^T - I| <= 2^-45 in each entry: the
//     constructor checks it to 2^-46, and the products err by less than 2^-49.
// (2) For each point p of its triangles |a_k (p - c)| <= h_k: h_k has 2^-43 to spare, for c, whose computation
//     errs by less than 2^-49, and for a_k c, which (1) makes differ from the middle along a_k by at most 2^-44.
// (3) For each vector u with |u| <= 1 + 2^-40, |u (p - c)| <= sum |u a_k| h_k + 2^-42: with t = A (p - c) and
//     r = (I - A^T A) (p - c) it is u (p - c) = (A u) t + u r. I - A^T A has the same norm as I - A A^T, less
//     than 3.1 2^-45 by (1), and |p - c| < 2.
// (4) If |u (c - c')| exceeds the sums of (3) for two boxes, without 2^-42, by `room`, the boxes are apart along
//     u by more than room - 2^-40: (3) twice is 2^-41, and the computation errs by less than 2^-44. The room
//     is 2^-39 plus 2^-47 times the largest coordinate in units of the map, 16 times what law (1) asks for.
// Normalising u is not needed: a shorter u makes the test stricter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/search/detail/vectors.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/separation_filter.hpp>

namespace terrane::search {

/// Maps the points of triangles into the cube of side 1 round 0, with one scale.
class UnitMap {
public:
    /// source: triangles. There is no scale, and all maps to 0, where the points are too close together.
    explicit UnitMap(const BoxSource& source, std::span<const std::uint32_t> chosen,
                     std::span<const std::uint32_t> others = {});

    [[nodiscard]] Vector operator()(const Point3& p) const {
        return {(p.x / 2 - half_centre_[0]) * factor_, (p.y / 2 - half_centre_[1]) * factor_,
                (p.z / 2 - half_centre_[2]) * factor_};
    }
    /// Returns by how much turned boxes must be apart; see statement (4).
    [[nodiscard]] double room() const { return room_; }

private:
    Vector half_centre_{};
    double factor_ = 0, room_ = 0x1p-39;
};

/// A box along axes of its own, which are orthonormal but for statement (1).
struct TurnedBox {
    std::array<Vector, 3> axes; ///< first the direction in which the triangles are long
    Vector centre, half;        ///< half: of its lengths along the axes

    /// Whether the triangles of both are certainly apart.
    [[nodiscard]] bool is_apart(const TurnedBox& o, double room) const;
};

/// Returns a box round triangles, whose corners are in units of a UnitMap.
TurnedBox turned_box(std::span<const std::array<Vector, 3>> triangles);

/// Labels of triangles. A join leaves out pairs of triangles that have a label in common. A list may be empty.
struct PairLabels {
    std::span<const std::uint32_t> groups, crowds; ///< per triangle of the source, or no_group
};

/// A binary tree of turned boxes. The order of the triangles follows their places and directions.
/// Cost: n log n.
class TurnedTree {
public:
    static constexpr std::uint32_t leaf_size = 8;

    TurnedTree(const BoxSource& source, std::span<const std::uint32_t> chosen,
               const PairLabels& labels, const UnitMap& map);

    /// Returns the number of leaves of at most leaf_size triangles.
    [[nodiscard]] std::size_t leaf_count() const { return leaves_.size(); }

    /// Calls report(triangle here, triangle there) once for each pair, one in a leaf of this tree and
    /// one in the other, whose boxes overlap, that have no label in common, and that are not certainly
    /// apart. Both trees must have the same map. If both are the same object, a leaf reports only the
    /// pairs that no leaf with a smaller number reports.
    template <class Report>
    void join(std::size_t leaf, const TurnedTree& other, const Report& report) const {
        const Node& here = nodes_[leaves_[leaf]];
        std::array<std::optional<SeparationFilter>, leaf_size> filters;
        std::array<std::uint32_t, 64> stack; // NOLINT: filled as far as used
        unsigned top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const std::uint32_t at = stack[--top];
            const Node& there = other.nodes_[at];
            if (this == &other && there.end <= here.first) continue;
            if (have_one_label(here, there) || here.box.is_apart(there.box, room_)) continue;
            if (there.right != 0) {
                stack[top++] = there.right;
                stack[top++] = at + 1;
                continue;
            }
            join_leaves(here, other, there, filters, report);
        }
    }

private:
    struct Node {
        TurnedBox box;
        std::uint32_t first, end; ///< of order_
        std::uint32_t right = 0;  ///< child; the left one follows the node. 0: a leaf
        std::uint32_t group = no_group, crowd = no_group; ///< of all triangles
    };
    struct Item;

    std::uint32_t add(std::span<Item> items, std::uint32_t first);

    [[nodiscard]] static bool have_one_label(const Node& a, const Node& b) {
        return (a.group != no_group && a.group == b.group) ||
               (a.crowd != no_group && a.crowd == b.crowd);
    }
    [[nodiscard]] static std::uint32_t label(std::span<const std::uint32_t> labels,
                                             std::uint32_t t) {
        return labels.empty() ? no_group : labels[t];
    }
    [[nodiscard]] bool have_one_label(std::uint32_t f, std::uint32_t g) const {
        const std::uint32_t group = label(labels_.groups, f), crowd = label(labels_.crowds, f);
        return (group != no_group && group == labels_.groups[g]) ||
               (crowd != no_group && crowd == labels_.crowds[g]);
    }
    [[nodiscard]] std::array<Point3, 3> corners(std::uint32_t t) const {
        const Triangle& c = source_.triangles()[t];
        return {source_.points()[c[0]], source_.points()[c[1]], source_.points()[c[2]]};
    }
    [[nodiscard]] bool are_joined(std::uint32_t f, std::uint32_t g) const {
        const Triangle &t = source_.triangles()[f], &u = source_.triangles()[g];
        for (const std::uint32_t v : t)
            if (v == u[0] || v == u[1] || v == u[2]) return true;
        return false;
    }

    template <class Report>
    void join_leaves(const Node& here, const TurnedTree& other, const Node& there,
                     std::array<std::optional<SeparationFilter>, leaf_size>& filters,
                     const Report& report) const {
        const bool same = &here == &there;
        for (std::uint32_t j = there.first; j < there.end; ++j) {
            const std::uint32_t g = other.order_[j];
            const Box& box = other.boxes_[j];
            for (std::uint32_t i = here.first; i < (same ? j : here.end); ++i) {
                const std::uint32_t f = order_[i];
                if (!boxes_[i].overlaps(box) || have_one_label(f, g)) continue;
                if (!are_joined(f, g)) {
                    auto& filter = filters[i - here.first]; // NOLINT: a leaf has at most leaf_size
                    if (!filter) {
                        const auto [a, b, c] = corners(f);
                        filter.emplace(a, b, c);
                    }
                    const auto [p, q, r] = other.corners(g);
                    if (filter->is_apart(p, q, r)) continue;
                }
                report(f, g);
            }
        }
    }

    BoxSource source_;
    PairLabels labels_;
    double room_;
    std::vector<std::uint32_t> order_;  ///< the chosen triangles
    std::vector<Box> boxes_;            ///< of the triangles, in this order
    std::vector<Node> nodes_;           ///< a child follows its parent
    std::vector<std::uint32_t> leaves_; ///< nodes, in the order of their triangles
};

} // namespace terrane::search
