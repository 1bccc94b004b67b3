// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Distances for the verifier: their squares as fractions of integers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

using Vector3 = std::array<mpz_class, 3>;

Vector3 difference(const Vector4& a, const Vector4& b); ///< a - w b. Precondition: b has w = 1
Vector3 cross(const Vector3& a, const Vector3& b);
mpz_class dot(const Vector3& a, const Vector3& b);
/// Returns the normal of a triangle, as long as twice its area. Precondition: its corners have w = 1.
Vector3 normal_of(const std::array<const Vector4*, 3>& triangle);

/// The square of a distance, above / below, in the unit of the points; not reduced.
struct Squared {
    mpz_class above = 0;
    mpz_class below = 1; ///< > 0

    friend bool operator<(const Squared& a, const Squared& b) {
        return a.above * b.below < b.above * a.below;
    }
};

Squared squared_distance(const Vector4& a, const Vector4& b);
/// Precondition: the ends of the segment have w = 1.
Squared squared_distance(const Vector4& point, const Vector4& start, const Vector4& end);
/// Precondition: the corners of the triangle have w = 1. Without area it is its longest side.
Squared squared_distance(const Vector4& point, const std::array<const Vector4*, 3>& triangle);

/// Tells whether the distance is at most `bound`.
bool within(const Squared& distance, const mpz_class& bound);

/// Returns the smallest height of a triangle with area, squared. Precondition: its corners have
/// w = 1.
Squared squared_height(const std::array<const Vector4*, 3>& triangle);

/// Returns a double that is at least the distance over `scale`, and exceeds it by a few units in
/// the last place at most; 0 for 0.
double root_above(const Squared& distance, const mpz_class& scale);

/// Tells whether two points are at most `bound` apart; all numbers have the same scale.
bool within(const Vector4& a, const Vector4& b, const mpz_class& bound);

/// Tells whether a point is at most `bound` away from a segment, whose ends have w = 1.
bool within_of_segment(const Vector4& point, const Vector4& start, const Vector4& end,
                       const mpz_class& bound);

/// Tells whether a point is at most `bound` away from a (closed) triangle, whose corners have w =
/// 1.
bool within(const Vector4& point, const std::array<const Vector4*, 3>& triangle,
            const mpz_class& bound);

/// Triangles that segments are to be near: at most `bound` away. A triangle with two equal corners
/// is a segment. It holds references to points and triangles. Precondition: all points have w = 1.
/// Cost: n log n for n triangles, then log n for each triangle whose box is near what is asked for.
class NearTriangles {
public:
    NearTriangles(std::span<const Vector4> points, std::span<const Triangle> triangles,
                  const mpz_class& bound);

    /// Tells whether one triangle is near two points, and so near all between them: the distance to
    /// a triangle is convex.
    [[nodiscard]] bool has_one(const Vector4& p, const Vector4& q) const;

    /// Tells whether each point of a segment is shown to be near some triangle. The segment is
    /// divided at the corners of triangles that are near it, and pieces are halved where one
    /// triangle takes over from another. Precondition: its ends have w = 1 and differ.
    [[nodiscard]] bool reach(const Vector4& start, const Vector4& end) const;

private:
    struct Segment;
    static constexpr std::size_t few = 16; ///< triangles; for fewer a tree takes longer

    [[nodiscard]] bool is_near(const Vector4& point, std::uint32_t t) const;
    /// Returns the triangles that may be near a segment.
    [[nodiscard]] std::vector<std::uint32_t> around(const Vector4& p, const Vector4& q) const;
    [[nodiscard]] bool piece_is_near(const Segment& segment, const mpz_class& from,
                                     const mpz_class& to, const Edge& corners) const;
    [[nodiscard]] bool is_near_by_halves(const Segment& segment, const mpz_class& from,
                                         const mpz_class& to, unsigned halvings) const;

    std::span<const Vector4> points_;
    std::span<const Triangle> triangles_;
    mpz_class bound_;
    std::vector<std::uint32_t> all_;
    std::vector<Edge> at_corner_; ///< {corner, triangle}, sorted
    BoxTree tree_;
};

} // namespace terrane::verifier
