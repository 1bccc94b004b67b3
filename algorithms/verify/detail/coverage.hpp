// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Internal to the verifier: rule R18, whether what is left of an input triangle (the parent) after
// its corners have moved a little (its children) still covers it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// Seen along the normal of the parent, its children are triangles in a plane. Their union ends
/// only along edges. If each point in which it ends is within `collar` of the border of the parent,
/// then, the parent less that collar being connected, the union covers all of this or nothing; the
/// centroid tells which. (A parent that is so thin that the centroid is in the collar is not
/// asked for it.)
/// Holds references to the points. All points have w = 1.
class Coverage {
public:
    /// Precondition: the parent has area.
    Coverage(const std::array<const Vector4*, 3>& parent, std::span<const Vector4> points,
             const mpz_class& collar);

    /// Cost: some ten products of integers per edge; where the children overlap, that for each
    /// pair of such an edge and a child.
    [[nodiscard]] bool holds(std::span<const Triangle> children) const;

private:
    struct Side {
        Edge edge;
        int sign; ///< on which side of the edge a child lies; never 0
    };

    [[nodiscard]] int side_of(const Vector4& from, const Vector4& to, const Vector4& point) const;
    [[nodiscard]] bool covers_centroid(std::span<const Triangle> children) const;
    [[nodiscard]] bool has_in(const Triangle& child, const Vector4& point) const;
    [[nodiscard]] bool near_border(const Vector4& a, const Vector4& b) const;
    [[nodiscard]] bool covered_elsewhere(const Side& side,
                                         std::span<const Triangle> children) const;
    [[nodiscard]] std::vector<Vector4> crossings(const Edge& edge,
                                                 std::span<const Triangle> children) const;
    [[nodiscard]] bool covers_beside(const Triangle& child, const Side& side,
                                     const Vector4& point) const;
    [[nodiscard]] std::vector<Triangle> facing(std::span<const Triangle> children) const;

    std::array<const Vector4*, 3> parent_;
    std::span<const Vector4> points_;
    mpz_class collar_;
    Vector3 normal_;
};

} // namespace terrane::verifier
