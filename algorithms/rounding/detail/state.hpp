// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::rounding::detail {

class CollapsedTriangles;

/// The mesh of doubles between rounds of snapping.
///
/// A vertex is dirty when it has moved since its triangles were known to be conforming. Two
/// triangles without a dirty corner meet properly.
///
/// Whatever moves, merges or collapses, the parts of an input triangle hang together as they did:
/// where triangles that became lines go, the sides that met there are the same again, divided at
/// the same points. So no move opens a slit between parts.
struct RoundingState {
    std::vector<Point3> points;
    std::vector<double> move;   ///< per point: at most this far from its exact point
    std::vector<bool> is_dirty; ///< per point
    std::vector<Triangle> triangles;
    IndexLists<std::uint32_t> parents_of; ///< per triangle, sorted
    std::size_t input_vertices = 0;       ///< the first points are input vertices
    std::size_t merged = 0;               ///< points that became another one
    std::size_t collapsed = 0;            ///< triangles that lost their area
    double deviation = 0;                 ///< sum over the ended rounds of the largest move
    std::vector<std::uint32_t>
        found_dirty; ///< dirty_triangles(), if the last tidy() changed nothing

    [[nodiscard]] std::vector<std::uint32_t> dirty_triangles(const Run& run) const;

    /// Makes the corners of these triangles dirty and all other points not: right where these are
    /// all the pairs that meet improperly.
    void only_dirty(std::span<const CandidatePair> improper);

    /// Appends a dirty point that is at most `moved` from its exact place.
    void add_point(const Point3& p, double moved);

    /// Moves each point whose snap(point) is one of `cells` there.
    template <class Snap>
    void move_into(std::span<const Point3> cells, const Snap& snap);

    /// Merges equal points, drops triangles without area, divides the sides next to those at their
    /// corners, joins equal triangles. True if anything changed.
    /// Cost: a pass over all points, exact tests for triangles with dirty corners only.
    bool tidy(const Run& run);

    /// Takes new triangles, each contained in the triangles faces_of names.
    void replace_triangles(std::vector<Triangle> fresh, const IndexLists<std::uint32_t>& faces_of);

    void drop_unused_points();

    /// Adds the largest move since the last call to the deviation.
    void end_round();

private:
    void move_point(std::size_t v, const Point3& to);
    bool merge_points(const Run& run);
    void join_equal(std::span<const std::uint32_t> dirty, std::vector<bool>& gone);
    void find_gaps(const std::vector<bool>& gone);
    bool divide_sides(const CollapsedTriangles& lines);

    double largest_move_ = 0;
    double largest_gap_ = 0; ///< half the length of a line to which triangles collapsed and that no
                             ///< other triangle contains
};

/// At least the distance between a point and its nearest doubles; in the unit of the points.
double rounding_bound(const PointStore& points, PointIndex p);
/// At least the distance between the point enclosed and p.
double distance_bound(const Enclosure& e, const Point3& p);

template <class Snap>
void RoundingState::move_into(std::span<const Point3> cells, const Snap& snap) {
    const std::unordered_set<Point3, PointHash> wanted(cells.begin(), cells.end());
    for (std::size_t v = 0; v < points.size(); ++v) {
        const Point3 cell = snap(points[v]);
        if (cell != points[v] && wanted.contains(cell)) move_point(v, cell);
    }
}

} // namespace terrane::rounding::detail
