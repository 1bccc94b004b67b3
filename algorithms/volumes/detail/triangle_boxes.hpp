// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/volumes/complex.hpp>

namespace terrane::volumes {

/// A line along an axis in doubles, as far as boxes need it.
struct AxisLine {
    unsigned axis = 0;   ///< 0, 1 or 2
    bool known = false;  ///< without that it may be near every triangle
    double u = 0, v = 0; ///< coordinates along the two axes that follow
};

/// Finds the triangles near lines along axes, by a tree of boxes that enclose the exact triangles.
class TriangleBoxes {
public:
    /// Takes the first `count` triangles of a complex, which must outlive it.
    TriangleBoxes(const TriangleComplex& sheets, std::uint32_t count) :
        sheets_(sheets), count_(count) {}
    /// Makes the tree that descend() needs. Cost: O(n log n).
    void build_tree();

    /// Whether a line may meet a triangle. Needs no tree.
    [[nodiscard]] bool is_near(std::uint32_t triangle, const AxisLine& line) const;

    /// Calls visit(triangle) for the triangles whose boxes the line meets at heights below `top`. It
    /// returns a height, below which no triangle is of interest; boxes that reach high come first.
    template <class Visit>
    void descend(const AxisLine& line, double top, const Visit& visit) const {
        double bottom = -HUGE_VAL;
        std::vector<std::uint32_t> open;
        if (!nodes_.empty()) open.push_back(0);
        while (!open.empty()) {
            const Node& node = nodes_[open.back()];
            open.pop_back();
            ++visits_;
            if (!is_met(node.box, line, top, bottom)) continue;
            if (node.children > 0) {
                const bool second_is_higher = nodes_[node.children].box.high[line.axis] <
                                              nodes_[node.children + 1].box.high[line.axis];
                open.push_back(node.children + (second_is_higher ? 0 : 1));
                open.push_back(node.children + (second_is_higher ? 1 : 0));
                continue;
            }
            for (std::uint32_t i = node.first; i < node.last; ++i)
                if (is_met(boxes_[order_[i]], line, top, bottom))
                    bottom = std::max(bottom, visit(order_[i]));
        }
    }
    /// Returns the number of nodes that were looked at: a measure of the cost.
    [[nodiscard]] std::size_t visits() const { return visits_; }

private:
    struct Node {
        Enclosure box{};
        std::uint32_t first = 0, last = 0; ///< in order_
        std::uint32_t children = 0;        ///< the first of two; 0: a leaf
    };

    static bool is_met(const Enclosure& box, const AxisLine& line, double top, double bottom) {
        const unsigned u = (line.axis + 1) % 3, v = (line.axis + 2) % 3;
        if (!line.known) return true;
        return box.low[u] <= line.u && line.u <= box.high[u] && box.low[v] <= line.v &&
               line.v <= box.high[v] && box.low[line.axis] <= top && box.high[line.axis] >= bottom;
    }

    const TriangleComplex& sheets_;
    std::uint32_t count_;
    std::vector<Enclosure> boxes_;     ///< per triangle
    std::vector<std::uint32_t> order_; ///< triangles in the order of the leaves
    std::vector<Node> nodes_;
    mutable std::size_t visits_ = 0;
};

} // namespace terrane::volumes
