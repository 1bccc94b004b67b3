// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Bounds the distance of triangles and edges of one mesh from those of another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// Points as doubles and as integers; all integers have the same scale, and w = 1.
struct PointPairs {
    std::span<const Point3> doubles;
    std::span<const Vector4> exact;
    double rounding = 0; ///< more than the error of distances in double precision
};

/// Returns a number that exceeds the error of distances between points in double precision.
double rounding_of(std::span<const Point3> points);

/// A distance as a double and as an integer of the scale of the points.
struct Bound {
    double distance = 0;
    mpz_class exact;
};

/// Triangles that others are to be near. A triangle with two equal corners is a segment.
/// It holds references to the points.
class Nearness {
public:
    Nearness(const PointPairs& points, std::vector<Triangle> targets);

    /// Tells whether each point of a triangle is shown to be at most `bound` away from some target.
    /// The distance to one target is convex, so a piece of the triangle is near it if its corners
    /// are. The triangle is halved until each piece is near one target, or a corner is near none.
    /// Numbers in double precision choose the target, rational numbers decide. Also false
    /// where more pieces would be needed than are left, of some for each target and each triangle
    /// that was asked for. Cost: some microseconds per piece; few pieces unless the bound is small
    /// relative to the triangle.
    [[nodiscard]] bool covers(const Triangle& triangle, const Bound& bound) const;

private:
    struct Corner {
        Point3 near;
        Vector4 exact;
    };
    using Piece = std::array<Corner, 3>;

    /// Returns the distance within which doubles propose targets.
    [[nodiscard]] double reach(const Bound& bound) const {
        return bound.distance * (1 + 0x1p-20) + points_.rounding;
    }

    static constexpr std::size_t first_pieces = 200'000, pieces_per_triangle = 256;

    [[nodiscard]] bool is_near_one(const Piece& piece, std::span<const std::uint32_t> targets,
                                   const Bound& bound) const;
    [[nodiscard]] bool is_near(const Piece& piece, std::uint32_t target, const Bound& bound) const;
    /// Tells whether a corner of the piece is farther away than `bound` from all targets.
    [[nodiscard]] bool is_refuted(const Piece& piece, std::span<const std::uint32_t> targets,
                                  const Bound& bound) const;
    [[nodiscard]] std::array<Point3, 3> corners(std::uint32_t target) const;
    [[nodiscard]] std::vector<std::uint32_t>
    within_reach(const Piece& piece, std::span<const std::uint32_t> targets, double reach) const;

    PointPairs points_;
    std::vector<Triangle> targets_;
    std::vector<Box> boxes_;
    BoxTree tree_;
    mutable std::size_t pieces_; ///< that are left
};

} // namespace terrane::verifier
