// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Finds the triangle nearest to a point, in floating point, by a tree of boxes that is split at
/// medians. The points must outlive it.
class TriangleTree {
public:
    TriangleTree(std::span<const Point3> points, std::vector<Triangle> triangles);

    /// Returns the distance to the nearest triangle if it is less than `bound`, otherwise `bound`.
    /// Cost: about O(log n) if the bound or the distance is small compared with the tree.
    [[nodiscard]] double distance(const Point3& p, double bound) const;

    struct Near {
        Point3 place{};
        double distance = 0;
        Triangle triangle{}; ///< the triangle that contains it
    };
    /// Returns the nearest point on the triangles if it is nearer than `bound`. Cost: as
    /// distance().
    [[nodiscard]] std::optional<Near> nearest(const Point3& p, double bound) const;
    /// Returns the nearest point of each triangle that is nearer than `bound`, in no order.
    [[nodiscard]] std::vector<Near> within(const Point3& p, double bound) const;

private:
    /// Calls visit(triangle) for the triangles that may be nearer than `bound`; visit may reduce
    /// it.
    template <class Visit>
    void for_near(const Point3& p, const double& bound, const Visit& visit) const;

    struct Node {
        Point3 low, high;
        std::uint32_t first = 0, last = 0; ///< triangles of the node
        std::uint32_t left = 0, right = 0; ///< children; 0: a leaf
    };

    struct Item;
    std::uint32_t build(std::vector<Item>& items, std::uint32_t first, std::uint32_t last);

    std::span<const Point3> points_;
    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

/// Returns the distance from p to a box, in floating point; 0 inside.
double distance_to_box(const Point3& p, const Point3& low, const Point3& high);

/// Returns the distance from p to a triangle, in floating point.
double distance_to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c);

/// Returns the point of a triangle that is nearest to p, in floating point.
Point3 nearest_on_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c);
} // namespace terrane
