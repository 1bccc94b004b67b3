// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The part of a triangle within a cell. A corner of it is named by what meets there, so that each decision is one
// about the corners of the triangle and coordinates of planes, which predicates make exactly:
// (1) a corner of the triangle has coordinates;
// (2) on an edge and a plane, another coordinate is compared by an orientation in the projection along the third axis;
// (3) on two planes, the third coordinate is compared by the side of a point with respect to the triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/predicates.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane::cells::detail {

inline double along(const Point3& p, std::size_t axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}
inline double& along(Point3& p, std::size_t axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// A triangle, and the signs of the coordinates of its normal.
struct CutTriangle {
    std::array<Point3, 3> corners;
    std::array<Sign, 3> normal;

    explicit CutTriangle(const std::array<Point3, 3>& of) : corners(of) {
        for (std::size_t a = 0; a < 3; ++a)
            normal[a] = orient2d(static_cast<Axis>(a), of[0], of[1], of[2]);
    }
    [[nodiscard]] bool is_level() const {
        return normal[0] == Sign::Zero && normal[1] == Sign::Zero;
    }
    [[nodiscard]] bool is_vertical() const { return normal[2] == Sign::Zero; }
};

/// A plane across an axis: 0, 1, 2 for x, y, z.
struct CellPlane {
    std::uint8_t axis = 0;
    double at = 0;
};

/// What a side of a part lies on: an edge of the triangle, from corner `edge` to the next, or a plane.
struct PartSide {
    std::uint8_t edge = 0; ///< 3: the plane
    CellPlane plane{};
};

/// A corner of a part, and the side that follows.
struct PartCorner {
    std::uint8_t planes = 0;       ///< on which it is: 0, 1 or 2
    std::uint8_t number = 0;       ///< of the triangle's corner, or with one plane of its edge
    std::array<CellPlane, 2> on{}; ///< across different axes
    PartSide side{};               ///< to the next corner
};

/// A part of a triangle: a convex polygon with an area.
class TrianglePart {
public:
    explicit TrianglePart(const CutTriangle& of) : triangle_(&of) {
        for (std::uint8_t k = 0; k < 3; ++k) {
            corners_[k].number = k;
            corners_[k].side.edge = k;
        }
    }

    [[nodiscard]] const CutTriangle& triangle() const { return *triangle_; }
    [[nodiscard]] bool is_empty() const { return size_ == 0; }
    [[nodiscard]] const PartCorner* begin() const { return corners_.data(); }
    [[nodiscard]] const PartCorner* end() const { return corners_.data() + size_; }

    /// Tells whether some of the part lies on this side of a plane, not in it.
    [[nodiscard]] bool reaches(const CellPlane& plane, Sign side) const {
        return std::any_of(begin(), end(),
                           [&](const PartCorner& c) { return side_of(c, plane) == side; });
    }

    /// Leaves what is on this side of a plane. Nothing is left if the part only touches it.
    void cut(const CellPlane& plane, Sign side);

private:
    /// Returns on which side of a plane a corner is; Positive: the coordinate is greater.
    [[nodiscard]] Sign side_of(const PartCorner& corner, const CellPlane& plane) const;
    void add(const PartCorner& corner, const PartSide& side) {
        corners_.at(size_) = corner;
        corners_[size_++].side = side;
    }

    const CutTriangle* triangle_;
    std::size_t size_ = 3;
    std::array<PartCorner, 10> corners_{}; ///< each of six planes adds one at most
};

/// The box of a cell.
struct CellBox {
    Point3 low, high;
};

/// Six times a volume over a part, and twice its area in the map, in units of the cell: > 0 where the front is up.
template <class N>
struct PartMoments {
    N area;   ///< twice the area
    N moment; ///< six times the volume between the part and the bottom of the cell
};

/// Computes the moments of a part in a number type.
template <class N>
class MomentsOfPart {
public:
    MomentsOfPart(const TrianglePart& part, const CellBox& box) : part_(part), box_(box) {
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t a = 0; a < 3; ++a)
                at_[k][a] = in_cell(along(part.triangle().corners[k], a), a);
    }

    /// A part above the grid has an area only.
    [[nodiscard]] PartMoments<N> operator()(bool with_moment) const {
        const PartCorner* c = part_.begin();
        const Place first = place(*c++, with_moment);
        Place before = place(*c++, with_moment);
        PartMoments<N> sum{N(0.0), N(0.0)};
        for (; c != part_.end(); ++c) {
            const Place next = place(*c, with_moment);
            const N area = (before[0] - first[0]) * (next[1] - first[1]) -
                           (before[1] - first[1]) * (next[0] - first[0]);
            sum.area = sum.area + area;
            if (with_moment) sum.moment = sum.moment + area * (first[2] + before[2] + next[2]);
            before = next;
        }
        return sum;
    }

private:
    using Place = std::array<N, 3>;

    [[nodiscard]] N in_cell(double x, std::size_t axis) const {
        const double low = along(box_.low, axis), high = along(box_.high, axis);
        if (x == low) return N(0.0);
        if (x == high) return N(1.0);
        return (N(x) - N(low)) / (N(high) - N(low));
    }

    [[nodiscard]] Place place(const PartCorner& corner, bool with_height) const {
        Place result;
        for (std::size_t a = 0; a < (with_height ? 3 : 2); ++a) result[a] = coordinate(corner, a);
        return result;
    }

    [[nodiscard]] N coordinate(const PartCorner& corner, std::size_t axis) const {
        if (corner.planes == 0) return at_[corner.number][axis];
        for (std::size_t i = 0; i < corner.planes; ++i)
            if (corner.on[i].axis == axis) return in_cell(corner.on[i].at, axis);
        const std::size_t a = corner.on[0].axis;
        const N on_a = in_cell(corner.on[0].at, a);
        if (corner.planes == 1) {
            const Place &p = at_[corner.number], &q = at_[(corner.number + 1) % 3];
            const N share = (on_a - p[a]) / (q[a] - p[a]);
            return p[axis] + share * (q[axis] - p[axis]);
        }
        const std::size_t b = corner.on[1].axis;
        const N on_b = in_cell(corner.on[1].at, b);
        const Place& p = at_[0];
        const N rise = normal(a) * (on_a - p[a]) + normal(b) * (on_b - p[b]);
        return p[axis] - rise / normal(axis);
    }

    [[nodiscard]] N normal(std::size_t axis) const {
        const std::size_t s = (axis + 1) % 3, t = (axis + 2) % 3;
        return (at_[1][s] - at_[0][s]) * (at_[2][t] - at_[0][t]) -
               (at_[1][t] - at_[0][t]) * (at_[2][s] - at_[0][s]);
    }

    const TrianglePart& part_;
    const CellBox& box_;
    std::array<Place, 3> at_; ///< corners of the triangle
};

} // namespace terrane::cells::detail
