// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Exact contacts of segments with the triangles of a conforming mesh, and the block around a point of a segment.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane::sections {

/// A segment between two different points.
struct PathSegment {
    Point3 a, b;
};

/// A place on a segment: a + share (b - a), share = above / below.
struct Share {
    Exact above{0.0}, below{1.0}; ///< below > 0

    friend bool operator<(const Share& s, const Share& t) {
        return exact_sign(s.above * t.below - t.above * s.below) == Sign::Negative;
    }
    friend bool operator==(const Share& s, const Share& t) {
        return exact_sign(s.above * t.below - t.above * s.below) == Sign::Zero;
    }
};

/// Returns the double nearest to the number that is `a` at share 0 and `b` at share 1, and linear between.
double number_at(const Share& share, double a, double b);

/// The part of a segment that lies in a triangle, which contains its border.
struct SegmentContact {
    Share from, to; ///< equal: the segment meets it in one point
    std::uint32_t triangle = 0;
    bool crosses = false;     ///< whether it meets the inside of the triangle in one point
    Sign first = Sign::Zero;  ///< side of the triangle on which a lies
    Sign second = Sign::Zero; ///< side of the triangle on which b lies
};

/// The triangles of a mesh, in a tree of boxes. Mesh and volumes must outlive it. Several threads may search at a time.
class SegmentSearch {
public:
    SegmentSearch(const Mesh& mesh, const Volumes& volumes);

    /// Returns all contacts of a segment, in no order. Triangles without area have none.
    [[nodiscard]] std::vector<SegmentContact> contacts(const PathSegment& segment) const;

    /// Returns the block on a side of a triangle.
    [[nodiscard]] std::uint32_t block(std::uint32_t triangle, Sign side) const {
        return volumes_.of_sides.empty()
                   ? 0
                   : volumes_.of_sides[triangle][side == Sign::Positive ? 0 : 1];
    }
    /// Returns the block around the point of a segment half way between two shares, which lies on no triangle: the one
    /// below the lowest triangle above it, on a vertical line that is shifted by (e, e^2) for an infinitely small e.
    [[nodiscard]] std::uint32_t block_between(const PathSegment& segment, const Share& s,
                                              const Share& t) const;

private:
    struct Node {
        Point3 low, high;
        std::uint32_t first = 0, last = 0; ///< in order_
        std::uint32_t children = 0;        ///< the first of two; 0: a leaf
    };

    template <class Visit>
    void for_near(const Point3& low, const Point3& high, const Visit& visit) const;

    const Mesh& mesh_;
    const Volumes& volumes_;
    std::vector<std::uint32_t> order_; ///< triangles in the order of the leaves
    std::vector<Node> nodes_;
};

} // namespace terrane::sections
