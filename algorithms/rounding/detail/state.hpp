// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
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
/// (1) A vertex is dirty if it has moved since its triangles were known to be conforming. Two
///     triangles without a dirty corner meet properly.
/// (2) The parts of an input triangle stay connected, whatever moves, merges or collapses. When
///     triangles that became lines are dropped, the sides that met there are divided at the same
///     points and therefore coincide again. So no move opens a slit between parts. If this would
///     multiply the triangles, the sides stay undivided: the mesh is torn, and no point may move.
struct RoundingState {
    std::vector<Point3> points;
    std::vector<double> move;       ///< per point: upper bound of the distance from its exact point
    std::vector<bool> is_dirty;     ///< per point: see (1)
    std::vector<bool> was_searched; ///< per point: whether it was dirty in a search that tests each
                                    ///< pair of overlapping boxes; points that are missing were not
    std::vector<Triangle> triangles;
    IndexLists<std::uint32_t> parents_of; ///< per triangle, sorted
    std::size_t input_vertices = 0;       ///< the first points are input vertices
    std::vector<bool> is_merged; ///< per point: whether another one took its place, as it became
                                 ///< equal; points that are missing were not merged
    std::size_t collapsed = 0;   ///< number of triangles that lost their area
    double deviation = 0;        ///< sum of the largest moves of all ended rounds
    double gaps = 0;             ///< sum of the largest gaps of all ended rounds
    bool is_torn = false; ///< whether sides that met at dropped triangles do not coincide; see (2)
    std::vector<std::uint32_t>
        found_dirty;                     ///< dirty_triangles(), if the last tidy() changed nothing
    std::vector<std::uint32_t> origins;  ///< per triangle: the one at the beginning in whose place
                                         ///< it is; empty if nobody asks
    std::size_t triangles_elsewhere = 0; ///< number, if these are a part of a mesh

    /// Returns the triangles with a dirty corner, ascending.
    [[nodiscard]] std::vector<std::uint32_t> dirty_triangles(const Run& run) const;

    /// Notes that all pairs with a dirty corner are being tested.
    void search_dirty();
    /// Tells whether all pairs with a triangle have been tested since it took its place.
    [[nodiscard]] bool is_tested(const Triangle& t) const;

    /// Marks the corners of these triangles as dirty and all other points as not dirty.
    /// Precondition: these are all pairs that meet improperly.
    void only_dirty(std::span<const CandidatePair> improper);

    /// Appends a dirty point whose distance from its exact place is at most `moved`.
    void add_point(const Point3& p, double moved);

    /// Moves each point p for which snap(p) is one of `cells` to snap(p).
    template <class Snap>
    void move_into(std::span<const Point3> cells, const Snap& snap);

    /// Merges equal points, drops triangles without area, divides the sides of their neighbours at
    /// their corners and joins equal triangles. Returns whether anything changed. If division would
    /// multiply the triangles, the mesh is torn instead. Cost: a pass over all points, and exact
    /// tests for triangles with dirty corners only.
    bool tidy(const Run& run);

    /// Takes superfluous parts from input triangles whose parts enclose a space, so that none do any
    /// more, and drops triangles that are no part of any then. Surfaces moved by `moved`, and points
    /// where a part was taken are up to twice as far from the others: see statement (5) of
    /// docs/explanation/rounding.md.
    void open_closed_parts(double moved);

    /// Replaces all triangles by new ones. faces_of lists for each the old triangles that contain
    /// it.
    void replace_triangles(std::vector<Triangle> fresh, const IndexLists<std::uint32_t>& faces_of);

    /// Returns the number of points that were merged with another one.
    [[nodiscard]] std::size_t merged() const;

    /// Drops the points that no triangle uses, such as merged ones. All other lists of points are
    /// no longer valid afterwards.
    void drop_unused_points();

    /// Adds the largest move since the last call to the deviation, and the largest gap to the gaps.
    void end_round();
    /// Returns the gaps with those since the last round ended.
    [[nodiscard]] double total_gaps() const;

    /// Moves a point, which is dirty then.
    void move_point(std::size_t v, const Point3& to);
    /// Notes that points elsewhere have moved that far in this round.
    void note_move_elsewhere(double moved) { largest_move_ = std::max(largest_move_, moved); }
    /// Returns the number of triangles, with those elsewhere.
    [[nodiscard]] std::size_t all_triangles() const {
        return triangles.size() + triangles_elsewhere;
    }

private:
    std::vector<bool> merge_points(const Run& run);
    void join_equal(std::span<const std::uint32_t> dirty, std::vector<bool>& gone);
    void find_gaps(const std::vector<bool>& gone);
    bool divide_sides(const CollapsedTriangles& lines);

    double largest_move_ = 0;
    double largest_gap_ = 0; ///< since the last end_round(): no point of a line to which triangles
                             ///< collapsed is farther from the mesh
};

/// Returns an upper bound of the length of a vector with these components, which are not negative.
double length_bound(double x, double y, double z);
/// Returns an upper bound of the distance between a point and its nearest doubles.
double rounding_bound(const PointStore& points, PointIndex p);
/// Returns an upper bound of the distance between the enclosed point and p.
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
