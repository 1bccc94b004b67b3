// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The four operations of remeshing, each as a pass over the whole mesh.
//
// - Splitting: edges longer than 4/3 of the target length are split in the middle, the longest
//   class first. Each round divides a triangle at most once and swaps edges afterwards, so that
//   slivers are not halved again and again.
// - Collapsing: edges shorter than 4/5 of the target length are collapsed; an inner vertex into any
//   neighbour, a vertex of a curve into a neighbour on the curve. The two ends may have no common
//   neighbours other than those in the triangles at the edge (the link condition: Dey et al. 1999),
//   so the topology does not change.
// - Swapping: inner edges are swapped if that reduces the largest angle of their two triangles.
// - Smoothing by trapezium drawing: each triangle at a vertex slides it parallel to the opposite
//   edge until it is above the middle of that edge. The trapezium of the old and the new position
//   on that edge lies in the plane of the triangle, so the surface keeps its shape. The vertex
//   moves by twice the mean of these proposals and is projected to the original surface along an
//   axis. Vertices of curves move along them, to halfway between their neighbours. A vertex moves
//   only if that reduces the sum of 1 / q.
// Every pass of smoothing visits vertices inside of one injective patch first, then the others, see
// change_validator.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/quality/detail/change_validator.hpp>

namespace terrane::quality::detail {

/// A proposed change, with the data that led to it.
struct Proposal {
    Change change{};
    CheckedChange checked{};
    bool is_allowed = false;    ///< by the mesh of that time
    bool is_tried = false;      ///< smoothing: the vertex had to be tried
    std::uint32_t gone = none;  ///< collapse: the vertex that vanishes
    std::uint32_t kept = none;  ///< collapse: the vertex it is merged into
    std::uint32_t other = none; ///< collapse on a curve: the neighbour on the other side
    double at = 0;              ///< on a curve: arc length of the new position
    std::vector<std::uint32_t> at_edge{}, of_gone{}, of_kept{}, common{}, across{}; ///< collapse
};

/// The data that all operations share; referenced objects must outlive it.
struct RemeshContext {
    WorkMesh& mesh;
    ChangeValidator& validator;
    const ReferenceSurface& reference;
    std::span<const Point3> points;   ///< of the input
    const std::vector<Curve>& curves; ///< of the input
    std::vector<double> curve_bound;  ///< per curve: largest distance of an edge from it
    const Run& run;
    std::size_t splits = 0, collapses = 0, swaps = 0, moves = 0; ///< made so far
    // Times of the last sweeps: triangles unchanged since then need not be tried again.
    std::uint32_t equalized_at = 0, swapped_at = 0, collapsed_at = 0;
    std::vector<std::uint32_t> smoothed_at{}; ///< per vertex: when smoothing failed last
    std::vector<std::uint32_t> improved_at{}; ///< per vertex: when improve_worst() failed last
    std::vector<char> settled{};             ///< per vertex of the mesh at settled_at: see settle()
    std::uint32_t settled_at = 0;            ///< when settle() was called
    std::vector<Proposal> window{};          ///< proposals of the current window
    std::vector<std::uint32_t> touched_at{}; ///< per vertex: when it was changed last
};

/// Tells whether the straight edge between two positions on a curve is within the curve's tolerance
/// of the part of the curve between them, and the reverse: nearest points run through the whole
/// edge, as they change continuously.
bool chord_within_bound(const RemeshContext& context, std::uint32_t curve, double from, double to);
/// Computes the point of a curve at an arc length.
Point3 point_on(const RemeshContext& context, std::uint32_t curve, double at);

/// Prepares the change that moves a vertex: lists its star, without the new position.
void collect_star(const WorkMesh& mesh, std::uint32_t v, Change& change);
/// Sums the normals of the removed triangles, for each sheet.
void set_facing(const WorkMesh& mesh, Change& change);

double shape_of(const Point3& a, const Point3& b, const Point3& c); ///< q, see quality.hpp
inline double shape_of(const WorkMesh& mesh, const Triangle& t) {
    return shape_of(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

/// Makes the passes leave a finished mesh as it is, apart from vertices whose wanted lengths differ
/// from these ones, and from their neighbours that change.
void settle(RemeshContext& context, std::span<const double> lengths);
/// Tells whether the passes leave a vertex and its triangles as they are.
bool is_settled(const RemeshContext& context, std::uint32_t v);
inline bool is_settled_edge(const RemeshContext& context, std::uint32_t a, std::uint32_t b) {
    return is_settled(context, a) && is_settled(context, b);
}

// Passes. Each returns the number of changes made. curves.cpp defines those on curves, smooth.cpp
// defines smooth(), jitter(), improve_worst(), collect_star(), settle() and is_settled(), and
// surface.cpp defines the others.
std::size_t split_curves(RemeshContext& context);
std::size_t collapse_curves(RemeshContext& context);
std::size_t slide_curves(RemeshContext& context);
std::size_t split_edges(RemeshContext& context);
std::size_t collapse_edges(RemeshContext& context);
/// Collapses an edge of each triangle worse than `below` where that improves the worst triangle.
std::size_t collapse_bad(RemeshContext& context, double below);
/// Tries the collapse of each edge at the triangle's corners and the swap of each of its edges, and
/// makes what improves it, however long the edges become. Returns the number of changes.
std::size_t improve_triangle(RemeshContext& context, std::uint32_t t);
std::size_t swap_edges(RemeshContext& context);
/// Swaps edges so that valences come closer to six, unless that makes an angle too large. Smoothing
/// then improves these triangles beyond the former ones.
std::size_t equalize_valences(RemeshContext& context);
std::size_t smooth(RemeshContext& context);
/// Moves inner vertices a little, pseudo-randomly by their index, where all triangles are shaped
/// like half squares or worse: a regular grid of those is an equilibrium of smoothing, but not the
/// best one.
std::size_t jitter(RemeshContext& context);
/// Moves inner vertices of triangles worse than `below` so that the worst of their triangles
/// improves.
std::size_t improve_worst(RemeshContext& context, double below);

// Shared by curves.cpp and surface.cpp.
/// Tells whether the collapse of gone_kept[0] into gone_kept[1] is allowed, creates no edge longer
/// than `longest` and no triangle worse than both `least` and the worst one before.
bool propose_collapse(RemeshContext& context, const Edge& gone_kept, double longest, double least,
                      Proposal& proposal);
/// Updates vertex kinds and curves after a collapse was carried out.
void after_collapse(WorkMesh& mesh, const Proposal& proposal);

} // namespace terrane::quality::detail
