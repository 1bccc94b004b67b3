// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Improves the triangles of a conforming mesh of any number of surfaces. The surfaces stay
// conforming along their common curves. Long edges are split, short ones collapsed, edges are
// swapped where that reduces the largest angle, and vertices are smoothed by trapezium drawing.
//
// Guarantees:
// (1) The result is a conforming mesh. A change is made only if exact predicates on the doubles
//     show that it creates no improper contact, and the whole result is checked again at the end.
// (2) Corners do not move. Vertices of curves (edges with other than two triangles, edges between
//     different surfaces or regions, and creases) stay on the original curves. Sheets and curves
//     are only subdivided anew, so surfaces and regions keep their identity. A change that sweeps
//     over a vertex of another sheet is rejected. The volumes on the two sides of each sheet are
//     compared at the end as well; report.sides_kept holds the answer. (Where slivers are attached
//     to a curve, their order around it may change with the curve.)
// (3) Each point of the result is within max_deviation of its part of the original surface, proven
//     with rounding errors included; each edge of a curve is within a third of that distance of the
//     original curve.
// (4) The algorithm terminates: moves and swaps reduce a sum of shapes or the largest angle, and
//     the number of split and collapse passes is bounded.
// (5) The result depends neither on the number of threads nor on time, nor on the order of
//     vertices, triangles and surfaces: it numbers the mesh by place first.
// (6) No triangle of the result has a smaller q than the worst one of the input, or than
//     least_quality if that is less, up to rounding (a relative 1e-12). Where the wanted lengths
//     would leave such triangles, the mesh is improved again, so that triangles near them, or all,
//     never fall below that q.
// (7) Over a triangle of the input at a thin block, the tolerance of (3) is at most the share
//     thickness_share of the distance to the next sheet of about the same direction. Around a block
//     whose volume changes by more than max_volume_change, the tolerance becomes smaller, in up to
//     three more attempts. Cost: some microseconds per triangle and pass, then one exact check of
//     the whole mesh. Source: the paper, section 4. The alternation of the four operations follows
//     Botsch and Kobbelt (2004). Trapezium drawing is named after Semenova, Savchenko and Hagiwara
//     (2004), whose formula was not available. Here, each triangle at a vertex proposes to slide it
//     parallel to the opposite edge until it is above the middle of that edge; the vertex moves by
//     twice the mean of the proposals (each of them only sees the direction of its own edge) and is
//     then projected back to the surface.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/quality/improve_options.hpp>
#include <terrane/algorithms/quality/improved.hpp>

namespace terrane {

/// Checks by the surfaces alone, before they are arranged, what improve() refuses: a max_deviation below the
/// rounding errors of their coordinates, and more than max_triangles. Their number is estimated from
/// areas and wanted lengths, without curvature and what intersections add. Errors: bad_option, with the
/// option as its place.
Status check_improvable(std::span<const Surface> surfaces, const ImproveOptions& options);

/// Improves the mesh. Errors: bad_option; bad_number, bad_index; improper_contact if the mesh is
/// not conforming; nothing_to_do if it has no triangles; interrupted, out_of_memory.
Result<Improved> improve(const Mesh& mesh, const ImproveOptions& options = {}, const Run& run = {});

/// Improves a mesh that is proven conforming already, without another proof.
Result<Improved> improve(const ConformingMesh& mesh, const ImproveOptions& options = {},
                         const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> improve_constants();

} // namespace terrane
