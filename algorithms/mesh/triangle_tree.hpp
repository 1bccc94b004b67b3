// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Finds the triangle nearest to a point, in floating point, by a tree of boxes that is split at
/// medians, where a search gets there first. The points must outlive it. Several threads may search
/// at a time.
class TriangleTree {
public:
    TriangleTree(std::span<const Point3> points, std::vector<Triangle> triangles);
    ~TriangleTree();
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;
    TriangleTree(const TriangleTree&) = delete;
    TriangleTree& operator=(const TriangleTree&) = delete;

    /// Returns the distance to the nearest triangle if it is less than `bound`, otherwise `bound`.
    /// Cost: about O(log n) if the bound or the distance is small compared with the tree, once what it
    /// looks at has been split, which is linear in n for the first search.
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

    struct Node;
    struct Nodes;

    std::span<const Point3> points_;
    std::unique_ptr<Nodes> nodes_;
};

/// Returns the distance from p to a box, in floating point; 0 inside.
double distance_to_box(const Point3& p, const Point3& low, const Point3& high);

/// Returns the distance from p to a triangle, in floating point.
double distance_to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c);

/// Returns the point of a triangle that is nearest to p, in floating point.
Point3 nearest_on_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c);
} // namespace terrane
