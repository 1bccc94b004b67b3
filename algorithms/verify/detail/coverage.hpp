// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rule R18 of the verifier: whether the triangles that remain of an input triangle (the children of
// the parent) after their corners have moved a little still cover it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// A part of a triangle: a union of triangles with the same normal.
struct CoveredRegion {
    std::span<const Vector4> points;
    std::span<const Triangle> triangles; ///< indices into points
    std::span<const Triangle> borders;   ///< edges {a, b, b} of one triangle
};

/// Judges whether the children cover their parent except for a collar along its border.
/// Projected along the normal of the parent, the children are triangles in a plane, and the border
/// of their union consists of parts of edges. If all of it is within `collar` of the border of the
/// parent, the union covers all of the parent without the collar, or nothing of it, because that
/// set is connected; the centroid tells which. (In a parent so thin that its centroid is in the
/// collar, the centroid need not be covered.)
/// If only a region of the parent is to be covered, the same holds for each triangle of the region,
/// as the region's border is outside of all of them.
/// It holds references to the points. All points have w = 1.
class Coverage {
public:
    /// Precondition: the parent has area.
    Coverage(const std::array<const Vector4*, 3>& parent, std::span<const Vector4> points,
             const mpz_class& collar);
    /// Only this region is to be covered.
    Coverage(const std::array<const Vector4*, 3>& parent, std::span<const Vector4> points,
             const mpz_class& collar, const CoveredRegion& region);

    /// Children that have area when projected along the normal, made counterclockwise, and a tree of
    /// their boxes in the projection.
    class Facing {
    public:
        Facing(const Coverage& coverage, std::span<const Triangle> children);
        Facing(const Facing&) = delete; // `near` refers to `triangles`
        Facing& operator=(const Facing&) = delete;
        /// Returns the children whose boxes touch that of two points. None: too many were asked for,
        /// as nothing but a forgery needs; then no more is proven.
        [[nodiscard]] std::optional<std::vector<Triangle>> around(const Vector4& p,
                                                                  const Vector4& q) const;
        /// Returns all as triangles to be near, by the collar.
        [[nodiscard]] const NearTriangles& near() const;

        std::vector<Triangle> triangles;

    private:
        const Coverage& coverage_;
        BoxTree tree_;
        mutable std::optional<NearTriangles> near_; ///< made for the first one that asks
        mutable std::size_t left_ = 0;              ///< that around() may still return
    };

    /// Tells whether the children cover the parent. Cost: n log n for n children, and some ten
    /// products of integers for each child over an edge with children on one side, 64 n of which are
    /// looked at. Where that does not suffice, it is not shown.
    [[nodiscard]] bool holds(const Facing& children) const;

    /// Tells whether each point of a segment lies in a child, or at most `collar` away from one. The
    /// segment lies in the parent. Precondition: its ends have w = 1 and differ when projected along
    /// the normal.
    [[nodiscard]] bool reaches(const Vector4& from, const Vector4& to,
                               const Facing& children) const;

private:
    [[nodiscard]] int side_of(const Vector4& from, const Vector4& to, const Vector4& point) const;
    [[nodiscard]] Box box_of(const Vector4& point) const;
    [[nodiscard]] bool covers_centroid(const std::array<const Vector4*, 3>& part,
                                       const Facing& children) const;
    [[nodiscard]] bool covers_centroids(const Facing& children) const;
    [[nodiscard]] bool near_border(const Edge& edge) const;
    [[nodiscard]] bool has_in(const Triangle& child, const Vector4& point) const;
    [[nodiscard]] bool near_border(const Vector4& a, const Vector4& b) const;
    template <class IsExempt>
    [[nodiscard]] bool is_covered(const Vector4& from, const Vector4& to, int side,
                                  const Facing& children, const IsExempt& is_exempt) const;

    std::array<const Vector4*, 3> parent_;
    std::span<const Vector4> points_;
    mpz_class collar_;
    Vector3 normal_, along_, across_;      ///< of the parent; the last two span its plane
    std::optional<CoveredRegion> region_;  ///< none: all of the parent
    std::optional<NearTriangles> borders_; ///< of the region
};

} // namespace terrane::verifier
