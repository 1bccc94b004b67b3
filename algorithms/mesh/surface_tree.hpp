// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// The nearest surface to a point, and its distance.
struct NearestSurface {
    std::uint32_t surface = 0;
    double distance = 0;
    double reach =
        0; ///< the distance, or that to the box of the nearest triangle if rounding made it the larger
};

/// Triangles, and the surfaces that they belong to.
struct TrianglesOfSurfaces {
    std::span<const Point3> points;
    std::span<const Triangle> triangles;
    const IndexLists<std::uint32_t>& surfaces_of; ///< per triangle, ascending
};

/// Finds the surfaces near a point, in floating point, by one tree of boxes over the triangles of all
/// surfaces. A node whose triangles belong to few surfaces names them; a search that looks for others
/// passes over it. So neither the number of surfaces nor the size of the one that a border belongs to
/// counts. The surfaces must outlive the tree. Several threads may search at a time.
class SurfaceTree {
public:
    /// Cost: O(n log n).
    explicit SurfaceTree(const TrianglesOfSurfaces& all);

    /// Finds the nearest of all surfaces except those listed (ascending); the first among equals.
    /// Looks no farther than `bound`. Adds the number of nodes that it looks at to `visits`.
    [[nodiscard]] std::optional<NearestSurface> nearest(const Point3& p,
                                                        std::span<const std::uint32_t> but,
                                                        double bound,
                                                        std::size_t* visits = nullptr) const;
    /// Returns the surfaces with a triangle whose box is no farther than `bound`, except those listed; ascending.
    /// Distances to boxes are rounded in the order of their lengths, so that all nearer surfaces are among these.
    [[nodiscard]] std::vector<std::uint32_t>
    within(const Point3& p, std::span<const std::uint32_t> but, double bound) const;

private:
    static constexpr std::uint32_t most_named = 4;
    struct Node {
        Point3 low, high;
        std::uint32_t first, last; ///< in order_
        std::uint32_t least;       ///< lowest surface in it
        std::array<std::uint32_t, most_named> surfaces{};
        std::uint32_t count = 0;    ///< of surfaces; most_named + 1: more
        std::uint32_t children = 0; ///< the first of two; 0: a leaf

        void name(std::uint32_t surface);
        /// Tells whether all its triangles belong to listed surfaces only.
        [[nodiscard]] bool is_of(std::span<const std::uint32_t> listed) const;
    };
    /// The best that a search has found.
    struct Best;

    /// Returns a node of some triangles, from `first` to before `last` in order_.
    [[nodiscard]] Node node(std::uint32_t first, std::uint32_t last) const;
    /// Returns the distance to the box of a triangle.
    [[nodiscard]] double distance_to_box(const Point3& p, std::uint32_t triangle) const;
    void visit(const Point3& p, std::span<const std::uint32_t> but, std::uint32_t triangle,
               Best& best) const;

    const TrianglesOfSurfaces all_;
    std::vector<std::uint32_t> order_; ///< triangles of surfaces, in the order of the nodes
    std::vector<Node> nodes_;
};

} // namespace terrane
