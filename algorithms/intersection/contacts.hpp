// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Performs steps (b), (c) and (d) of the arrangement: finds all improper contacts in a triangle
// soup, sorts them by triangle, stores their points and identifies equal points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/intersection/tested_pairs.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// Distinct triangles with area over distinct points. No two triangles have the same three corners.
/// Points that no triangle uses may repeat others.
struct TriangleSoup {
    std::span<const Point3> points;
    std::span<const Triangle> triangles;
};

/// The line that carries a segment within its triangle's plane: the plane of triangle `other`, or
/// edge 0..2 of `other` where the two are coplanar.
struct SupportLine {
    std::uint32_t other;
    std::uint8_t edge = 3; ///< 0..2: the edge; 3: the plane

    [[nodiscard]] bool is_plane() const { return edge == 3; }
};

/// A point or segment that must appear in triangle `face`.
struct FaceConstraint {
    std::uint32_t face;
    SupportLine support;
    std::array<Simplex, 2> place;   ///< of the ends, on the face
    std::array<PointIndex, 2> ends; ///< equal for a point

    /// Whether this is a segment that does not lie along an edge of the face.
    [[nodiscard]] bool is_inner_segment() const;
};

/// A crossing of two inner segments of one face, strictly inside both; or, if both are the same, a
/// point that lies inside it.
struct FaceCrossing {
    std::uint32_t face;
    std::array<std::uint32_t, 2> pieces; ///< indices into Contacts::pieces
    PointIndex point;
};

/// Sets of coplanar triangles, most of which overlap: each plane is divided as a whole. Two coplanar
/// triangles that overlap are in one pool or in none.
struct PlanePools {
    std::vector<std::uint32_t> of;   ///< per triangle: its pool or no_group; empty without pools
    IndexLists<std::uint32_t> faces; ///< per pool: its triangles, ascending

    [[nodiscard]] bool are_one(std::uint32_t f, std::uint32_t g) const {
        return !of.empty() && of[f] != no_group && of[f] == of[g];
    }
    /// Returns the pool that is stored under this triangle, its first one, or no_group.
    [[nodiscard]] std::uint32_t led_by(std::uint32_t f) const {
        return of.empty() || of[f] == no_group || faces[of[f]].front() != f ? no_group : of[f];
    }
};

/// The contacts of a triangle soup.
struct Contacts {
    PointStore points;                   ///< the soup's points, then those of all contacts
    std::vector<FaceConstraint> pieces;  ///< by face, then in the order of pairs
    std::vector<FaceCrossing> crossings; ///< by face
    PlanePools pools;                    ///< the pieces of a pool are those of its first triangle
    std::vector<bool> overlapped;        ///< per triangle in no pool: whether a coplanar one
                                         ///< overlaps it
    std::vector<CandidatePair> near;     ///< candidates that may meet when points are rounded to
                                         ///< nearest doubles
    std::size_t candidates = 0;          ///< number of candidate pairs
    std::size_t improper = 0;            ///< number of pairs with an improper contact, without
                                         ///< pairs within a pool or in different planes of a
                                         ///< pencil, which are not tested
    PredicateCounts predicates;
};

struct Pencils;

/// Returns a function with which PointStore::append distributes its work over the run's threads.
PointStore::Share sharing(const Run& run);

/// Finds the pools. Cost: linear in the candidates; next to nothing without triangles that have many.
PlanePools find_plane_pools(const TriangleSoup& soup, std::span<const CandidatePair> candidates,
                            const Run& run);

/// Performs steps (b) and (c): tests all candidates and collects the points and segments that must
/// appear in each triangle. `points` are the soup's points; the store of the result takes them
/// over. Pairs of triangles in different planes of one pencil need not be candidates. Equal points and, in triangles with many, equal segments are merged as they come. So the
/// memory follows the distinct ones. tested: if not null, the known result per candidate, which is
/// not tested again; afterwards, the results of all but those within a pool.
Contacts find_contacts(const TriangleSoup& soup, std::vector<Point3> points,
                       std::span<const CandidatePair> candidates, const Pencils& pencils,
                       const Run& run, TestedPairs* tested = nullptr);

/// Merges collinear segments that overlap: in pools, whose edges become segments, and in triangles
/// with many segments on few lines. Fills `crossings` with the points that lie on merged segments.
void merge_segments(const TriangleSoup& soup, Contacts& contacts, const Run& run);

/// Finds where segments cross inside a face: adds to `crossings` and appends their points.
void find_crossings(const TriangleSoup& soup, Contacts& contacts, const Run& run);

/// The classes of equal points, and the order of the points.
struct PointOrder {
    std::vector<PointIndex> same_as;   ///< per point: the representative of the points equal to it
                                       ///< (an input point, or that with the smallest construction)
    std::vector<std::uint32_t> rank;   ///< per point in use: its place in the lexicographic order
    std::vector<PointIndex> ascending; ///< the constructed points that are representatives, in
                                       ///< lexicographic order
};

/// Performs step (d): orders all constructed points and the corners of all faces with pieces,
/// exactly.
PointOrder order_points(const TriangleSoup& soup, const Contacts& contacts, const Run& run);

} // namespace terrane
