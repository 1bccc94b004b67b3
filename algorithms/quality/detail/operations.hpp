// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The four operations, each in a pass over the whole mesh. Private to improve.
//
// - Splitting: edges longer than 4/3 of what is wanted, the longest class first, in the middle; in
//   rounds that divide a triangle once and swap what that makes, so that slivers are not halved
//   again and again.
// - Collapsing: edges shorter than 4/5 of it; an inner vertex into any neighbour, one of a curve
//   into a neighbour on it. The two ends may have no common neighbours but those in the triangles
//   at the edge (the link condition: Dey et al. 1999), so that nothing changes but the division.
// - Swapping: of inner edges, where that lessens the largest angle of the two triangles.
// - Smoothing by trapezium drawing: on each triangle at a vertex, the vertex slides parallel to the
//   opposite edge until it is above its middle: the trapezium of the old and the new place on that
//   edge lies in the triangle's plane, so the surface keeps its shape. The vertex goes twice the
//   way to the mean of these places, and straight up or down to the surface as it was. Vertices of
//   curves go along them, halfway between their neighbours. A vertex moves only where that lowers
//   the sum of 1 / q.
// Every pass visits first what is in one proven patch, then the rest, see improve_guard.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/quality/detail/change_validator.hpp>

namespace terrane::improving {

constexpr double long_share = 4.0 / 3;  ///< of the wanted length: longer edges are split
constexpr double short_share = 4.0 / 5; ///< of the wanted length: shorter ones are collapsed
constexpr double least_shape = 0.3;     ///< that collapses may leave where there was better

/// A change on its way, and where what leads to it is noted.
struct Proposal {
    Change change{};
    CheckedChange checked{};
    bool is_allowed = false;    ///< as the mesh was then
    bool is_tried = false;      ///< smoothing: there was reason to
    std::uint32_t gone = none;  ///< a collapse: the vertex
    std::uint32_t kept = none;  ///< a collapse: that into which it goes
    std::uint32_t other = none; ///< a collapse on a curve: the neighbour on the other side
    double at = 0;              ///< on a curve: length along it where the vertex is to be
    std::vector<std::uint32_t> at_edge{}, of_gone{}, of_kept{}, common{}, across{}; ///< a collapse
};

/// What all operations work on; what is named must outlive them.
struct RemeshContext {
    WorkMesh& mesh;
    ChangeValidator& validator;
    const ReferenceSurface& reference;
    std::span<const Point3> points;   ///< of the input
    const std::vector<Curve>& curves; ///< of the input
    std::vector<double> curve_bound;  ///< per curve: how far an edge may be from it
    const Run& run;
    std::size_t splits = 0, collapses = 0, swaps = 0, moves = 0; ///< made so far
    // When sweeps were made last: what has not changed since need not be looked at.
    std::uint32_t equalized_at = 0, swapped_at = 0, collapsed_at = 0;
    std::vector<std::uint32_t> smoothed_at{}; ///< per vertex: when it was tried in vain
    std::vector<std::uint32_t> improved_at{}; ///< the same
    std::vector<Proposal> window{};           ///< those at hand
    std::vector<std::uint32_t> touched_at{};  ///< per vertex: when a change had it last
};

/// Whether the straight edge between two places of a curve is within its bound of all between them,
/// and the reverse: nearest points run through the whole edge, as they change continuously.
bool chord_within_bound(const RemeshContext& context, std::uint32_t curve, double from, double to);
/// The point at this length along a curve.
Point3 point_on(const RemeshContext& context, std::uint32_t curve, double at);

/// The change that moves a vertex, but for where to.
void collect_star(const WorkMesh& mesh, std::uint32_t v, Change& change);
/// Sums of normals of the triangles that are removed.
void set_facing(const WorkMesh& mesh, Change& change);

double shape_of(const Point3& a, const Point3& b, const Point3& c); ///< q, see quality.hpp
inline double shape_of(const WorkMesh& mesh, const Triangle& t) {
    return shape_of(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

// Each returns how many changes were made.
std::size_t split_curves(RemeshContext& context);
std::size_t collapse_curves(RemeshContext& context);
std::size_t slide_curves(RemeshContext& context);
std::size_t split_edges(RemeshContext& context);
std::size_t collapse_edges(RemeshContext& context);
/// Collapses at triangles worse than `below`, where the worst gets better.
std::size_t collapse_bad(RemeshContext& context, double below);
std::size_t swap_edges(RemeshContext& context);
/// Swaps that bring numbers of edges at vertices nearer to six, unless an angle becomes large: what
/// smoothing then makes better than what was.
std::size_t equalize_valences(RemeshContext& context);
std::size_t smooth(RemeshContext& context);
/// Moves inner vertices a little, by their number, where all triangles are like halves of squares
/// or worse: a regular grid of those is a balance that smoothing alone does not leave, though not
/// the best one.
std::size_t jitter(RemeshContext& context);
/// Moves inner vertices of triangles worse than `below` so that the worst of them gets better.
std::size_t improve_worst(RemeshContext& context, double below);

// Shared by the passes.
/// Whether moving one vertex into the other is allowed, and makes no edge longer than that and no
/// triangle worse than `least`, or than what was there.
bool propose_collapse(RemeshContext& context, const Edge& gone_kept, double longest, double least,
                      Proposal& proposal);
/// What is left to be done when that was carried out.
void after_collapse(WorkMesh& mesh, const Proposal& proposal);

} // namespace terrane::improving
