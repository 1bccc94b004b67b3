// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Steps (b), (c) and (d) of the arrangement: all improper contacts of a soup of triangles, sorted
// by triangle, with their points in one store, equal points merged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// Distinct triangles with area over distinct points (a triangle's corners differ, no two triangles
/// have the same three; points that no triangle uses may repeat others).
struct TriangleSoup {
    std::span<const Point3> points;
    std::span<const Triangle> triangles;
};

/// The line that carries a segment within its triangle's plane: the plane of triangle `other`, or
/// edge 0..2 of `other` where the two are coplanar.
struct SupportLine {
    std::uint32_t other;
    std::uint8_t edge = 3; ///< 3: the plane

    [[nodiscard]] bool is_plane() const { return edge == 3; }
};

/// A point or segment that must appear in triangle `face`.
struct FaceConstraint {
    std::uint32_t face;
    SupportLine support;
    std::array<Simplex, 2> place;   ///< of the ends, on the face
    std::array<PointIndex, 2> ends; ///< equal for a point

    /// Not a point, and not along an edge of the face.
    [[nodiscard]] bool is_inner_segment() const;
};

/// Where two inner segments of one face cross, strictly inside both.
struct FaceCrossing {
    std::uint32_t face;
    std::array<std::uint32_t, 2> pieces; ///< indices into Contacts::pieces
    PointIndex point;
};

struct Contacts {
    PointStore points;                   ///< the soup's points, then those of all contacts
    std::vector<FaceConstraint> pieces;  ///< by face, then in the order of pairs
    std::vector<FaceCrossing> crossings; ///< by face
    std::vector<bool> overlapped;        ///< per triangle: some coplanar one overlaps it
    std::vector<CandidatePair> near;     ///< candidates that may meet when points are rounded to
                                         ///< nearest doubles
    std::size_t candidates = 0;          ///< pairs of boxes
    std::size_t improper = 0;            ///< pairs of triangles
    PredicateCounts predicates;
};

/// Has the work of PointStore::append done by the threads of the run.
PointStore::Share sharing(const Run& run);

/// Step (b), (c): the pieces. The store takes `points`: those of the soup.
Contacts find_contacts(const TriangleSoup& soup, std::vector<Point3> points,
                       std::span<const CandidatePair> candidates, const Run& run);

/// Where segments cross inside a face: fills in crossings and appends their points.
void find_crossings(const TriangleSoup& soup, Contacts& contacts, const Run& run);

/// Equal points by name, and their order.
struct PointOrder {
    std::vector<PointIndex> same_as; ///< per point: the one that stands for it (an input point, or
                                     ///< the one with the smallest construction)
    std::vector<std::uint32_t> rank; ///< per point in use: place in the lexicographic order
    std::vector<PointIndex> ascending; ///< the constructed points that stand for themselves, in
                                       ///< lexicographic order
};

/// Step (d): orders all constructed points and the corners of all faces with pieces, exactly.
PointOrder order_points(const TriangleSoup& soup, const Contacts& contacts, const Run& run);

} // namespace terrane
