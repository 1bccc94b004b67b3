// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Performs step (e) of the arrangement: computes the constrained Delaunay triangulation of points
// and segments in one triangle. The triangulation is exact and unique: it is Delaunay in a
// projection, and ties are broken by a symbolic perturbation that depends only on the order of the
// points. Two coplanar triangles therefore triangulate a common part in the same way.
// Source: Lawson flips; Avis and Toussaint (1982) for constraints; Devillers and Teillaud (2003) for ties.
// detail/segments.cpp inserts segments; triangulation.cpp defines all other functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include <terrane/algorithms/core/sort_by_key.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// A segment that must become a union of edges.
using Segment = std::array<PointIndex, 2>;

/// Three doubles in a projection, strictly round all points of a face. They stand for the corners
/// where the face is a region of any shape. Triangles at them are no part of the face.
struct Frame {
    std::array<double, 3> u{}, v{};

    /// The index of corner i, which no stored point has.
    static constexpr PointIndex corner(unsigned i) { return UINT32_MAX - 3 + i; }
    static constexpr bool has(PointIndex p) { return p >= corner(0) && p <= corner(2); }
};

/// The points and segments that divide one triangle. Different indices denote different points.
struct FaceInput {
    Axis axis = Axis::z;                                ///< see projection_axis
    std::array<PointIndex, 3> corners{};                ///< in either orientation
    std::array<std::vector<PointIndex>, 3> edge_points; ///< on the open edge i, from corner i to
                                                        ///< corner i + 1, in this order
    std::vector<PointIndex> inner_points;               ///< inside, in any order, each once
    std::vector<Segment> segments;                      ///< between the points above; they cross in
                                                        ///< these points only

    std::vector<std::uint32_t>
        segment_lines; ///< per segment a number below 2^31, equal only for segments on one line;
                       ///< or empty. It saves exact tests
    const Frame* frame = nullptr; ///< if set, corners are Frame::corner(0), (1), (2)
    std::stop_token stop{};       ///< if requested, the result is empty

    /// Removes all points and segments, but keeps the memory.
    void clear();
};

/// Triangulates faces one after the other and reuses its arrays. It must not outlive the guard
/// whose witness it is made with.
class FaceTriangulation {
public:
    explicit FaceTriangulation(UpwardWitness upward) : upward_(upward) {}

    /// Returns the triangles of a face, oriented as its corners; valid until the next call. rank[p]
    /// is the position of p in the lexicographic order of all points in use. Expected cost:
    /// n^(4/3) for n points, plus the number of edges that segments cross.
    std::span<const std::array<PointIndex, 3>> operator()(const PointStore& points,
                                                          std::span<const std::uint32_t> rank,
                                                          const FaceInput& face);

    /// Divides a face as operator() does, and lists no triangles.
    void divide(const PointStore& points, std::span<const std::uint32_t> rank,
                const FaceInput& face);

    /// Returns the triangles of the last face in an order that depends on its points alone and not on
    /// the order of work: each starts with its lowest corner, and they are sorted by their corners. A
    /// face of one triangle is returned as it is. Valid until the next call.
    std::span<const std::array<PointIndex, 3>> in_order();

    using Local = std::uint32_t; ///< index into points_ or cells_
    static constexpr Local none = UINT32_MAX;

    /// A triangle of the last face.
    struct Cell {
        std::array<Local, 3> v{};    ///< counterclockwise in the projection
        std::array<Local, 3> n{};    ///< neighbour across the edge opposite to v[i], or none
        std::array<bool, 3> fixed{}; ///< whether that edge is a constraint
    };

    /// An edge that lies on a segment.
    struct SegmentEdge {
        std::uint32_t segment; ///< index into the segments of the face
        std::array<Local, 2> ends;
    };

    /// Of the last face, until the next call: its triangles with their neighbours, the point of
    /// each Local, and the edges on each segment. The edges of one segment are consecutive and lie
    /// along it; the segments are in any order. Edges are kept for framed faces only.
    [[nodiscard]] std::span<const Cell> cells() const { return cells_; }
    [[nodiscard]] std::span<const PointIndex> points() const { return points_; }
    [[nodiscard]] std::span<const SegmentEdge> segment_edges() const { return segment_edges_; }

private:
    struct Side { ///< the edge of a cell opposite to v[i]
        Local cell;
        unsigned i;
    };

    struct Rim {              ///< an edge of a polygon
        Side beyond;          ///< in the cell on its other side; none: there is no cell
        bool fixed;           ///< whether it is a constraint
        bool is_slit = false; ///< both sides belong to polygons; `beyond` is outdated
    };

    struct Slit { ///< an edge with a new cell on one of its sides
        std::array<Local, 2> ends;
        Side side;
    };

    /// The region that the insertion of a segment leaves empty on one side of it.
    struct Polygon {
        std::vector<Local> points; ///< along it, both ends of the segment included
        std::vector<Rim> rims;     ///< rims[k] between points[k] and points[k + 1]

        void start(Local point) {
            points.assign(1, point);
            rims.clear();
        }
    };

    struct Inner { ///< an inner point
        ApproximatePoint at;
        PointIndex point;
    };

    void start(const FaceInput& face);
    void take_points(const FaceInput& face);
    void order_inner_points(const FaceInput& face);
    static void sort_into_strips(std::span<Inner> level);
    void name_points();
    [[nodiscard]] Local local(PointIndex p) const;
    void find_lines(const FaceInput& face);
    [[nodiscard]] bool on_one_line(Local a, Local b, Local c) const;
    void insert_edge_points(const FaceInput& face);
    void insert_inner_points(const FaceInput& face);
    void order_segments();
    void sort_points();
    void insert_segment(std::uint32_t segment);
    bool advance(Local u, Local v, Local& reached);
    void cross(Local u, Local v, Side first, Local& reached);
    void replace_crossed();
    Side fill(Polygon& polygon);
    void join(Side s, Rim rim);
    [[nodiscard]] Rim rim_at(Side s) const;
    void fix(Side s);

    void split_cell(Local cell, Local p);
    void split_edge(Side s, Local p);
    void flip(Side s);
    void legalise();
    void legalise_later(Side s) { todo_.push_back(s); }
    void link(Local cell, unsigned i, Local neighbour);
    void replace_neighbour(Local cell, Local old_cell, Local new_cell);

    [[nodiscard]] Side border_from(Local p) const;
    [[nodiscard]] Side locate(Local p, Local from) const;
    [[nodiscard]] unsigned index_in(Local cell, Local neighbour) const;
    [[nodiscard]] Sign turn(Local a, Local b, Local c) const;
    [[nodiscard]] Sign in_circle(const Cell& c, Local d) const;
    // These decide the few signs that the filters leave open. Inlined they would slow the filters down.
    [[nodiscard, gnu::noinline]] Sign certain_turn(Local a, Local b, Local c) const;
    [[nodiscard, gnu::noinline]] Sign certain_in_circle(const Cell& c, Local d) const;
    [[nodiscard, gnu::noinline]] bool in_perturbed_circle_through(const Cell& c, Local d) const;
    [[nodiscard]] bool must_flip(Side s) const;
    [[nodiscard]] ApproximatePoint approximate(PointIndex p) const;
    [[nodiscard]] ExactPoint exact(PointIndex p) const;
    [[nodiscard]] std::uint32_t rank_of(Local p) const;
    [[nodiscard]] bool in_perturbed_circle(const Cell& c, Local d) const;

    [[no_unique_address]] UpwardWitness upward_;
    const PointStore* store_ = nullptr;
    const Frame* frame_ = nullptr;
    std::span<const std::uint32_t> rank_;
    Axis axis_ = Axis::z;
    std::vector<PointIndex> points_;           ///< corners, edge points, inner points as inserted
    std::vector<ApproximatePoint> flat_;       ///< per point, in the projection
    std::vector<Local> slots_;                 ///< open addressing: points by hash of their index
    std::vector<Segment> segments_;            ///< those of the face, as local points
    std::vector<std::uint32_t> segment_order_; ///< in which they are inserted
    std::vector<std::uint32_t> first_line_; ///< per point, and the end: its first entry in lines_
    std::vector<std::uint32_t> lines_;
    std::vector<std::uint32_t> line_end_; ///< per point, while lines_ is filled: the next entry
    std::vector<Local> cell_of_;          ///< per point: a cell that has it as a corner
    std::vector<Cell> cells_;
    std::vector<Side> todo_;
    std::vector<Local> crossed_; ///< cells that a segment crosses, until new ones take their place
    Polygon left_, right_;       ///< of the segment
    std::vector<Slit> slits_;    ///< whose second cell is not made yet
    std::vector<std::pair<std::uint64_t, PointIndex>> order_; ///< inner points by level and rank
    std::vector<Inner> inner_;                                ///< inner points as inserted
    std::vector<SegmentEdge> segment_edges_;
    // While the triangles of a face are sorted:
    std::vector<Keyed> sorted_, scratch_;                ///< points by rank
    std::vector<PointIndex> by_rank_;                    ///< those of sorted_
    std::vector<std::uint32_t> positions_;               ///< per point, in sorted_
    std::vector<std::array<Local, 3>> turned_, ordered_; ///< triangles of positions, lowest first
    std::vector<std::uint32_t> by_second_, by_lowest_; ///< per position: the next triangle's place
    std::vector<std::array<PointIndex, 3>> result_;
    bool is_reversed_ = false; ///< the corners are clockwise in the projection
};

} // namespace terrane
