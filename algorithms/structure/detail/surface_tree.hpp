// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::structure::detail {

/// The nearest surface to a point, and its distance.
struct NearestSurface {
    std::uint32_t surface = 0;
    double distance = 0;
};

/// Finds the surface nearest to a point, in floating point, by one tree of boxes over the triangles of
/// all surfaces. A node whose triangles belong to few surfaces names them; a search that looks for
/// others passes over it. So neither the number of surfaces nor the size of the one that a border
/// belongs to counts. Nodes are split at medians where a search gets there first, so only one thread may
/// search at a time. The mesh must outlive it.
class SurfaceTree {
public:
    explicit SurfaceTree(const Mesh& mesh);

    /// Finds the nearest of all surfaces except those listed (ascending); the first among equals.
    /// Looks no farther than `bound`.
    [[nodiscard]] std::optional<NearestSurface>
    nearest(const Point3& p, std::span<const std::uint32_t> but, double bound);
    /// Returns the number of nodes that searches have looked at: a measure of the cost.
    [[nodiscard]] std::size_t visits() const { return visits_; }

private:
    static constexpr std::uint32_t most_named = 4;
    struct Node {
        Point3 low, high;
        std::uint32_t first, last; ///< in order_
        std::uint32_t least;       ///< lowest surface in it
        std::array<std::uint32_t, most_named> surfaces{};
        std::uint32_t count = 0;    ///< of surfaces; most_named + 1: more
        std::uint32_t children = 0; ///< the first of two; 0: a leaf, or not split yet

        void name(std::uint32_t surface);
        /// Tells whether all its triangles belong to listed surfaces only.
        [[nodiscard]] bool is_of(std::span<const std::uint32_t> listed) const;
    };
    /// The best that a search has found.
    struct Best;

    void add_node(std::uint32_t first, std::uint32_t last);
    void split(std::uint32_t node);
    void visit(const Point3& p, std::span<const std::uint32_t> but, std::uint32_t triangle,
               Best& best) const;

    const Mesh& mesh_;
    std::vector<std::uint32_t> order_; ///< triangles of surfaces, in the order of the nodes
    std::vector<Node> nodes_;
    std::size_t visits_ = 0;
};

} // namespace terrane::structure::detail
