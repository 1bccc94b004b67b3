// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rounds an arrangement from exact points to doubles. Each point goes to the nearest doubles. Where
// the mesh of doubles is then no longer conforming, iterated snap rounding moves the corners of the
// triangles that cross, and all points in the same grid cells. Inputs that were written as decimals
// are arranged as these decimals instead, so that triangles coplanar in decimals are coplanar.
//
// Guarantee: if report.clean, no two triangles of the mesh meet other than in a shared vertex or
// edge, none is degenerate and none is repeated, as exact predicates on the doubles have shown.
// Otherwise report.contacts lists the remaining pairs. There is no proof that the rounds succeed
// for every input; therefore the result is checked. No surface moves farther than options.max_move,
// whether report.clean or not, and no point leaves or passes a plane of a volume of interest that
// is parallel to two axes.
// Cost: nearest doubles of the constructed points and one box search for the triangles that have
// such points; then, per round, the same for the points that moved.
// Source: Valque and Lazard, Removing self-intersections in triangular meshes (2025), made local.
#pragma once

#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/rounded_mesh.hpp>

namespace terrane {

/// Returns the largest move that is allowed unless options say otherwise: 1024 times the spacing of
/// doubles at the largest coordinate (docs/explanation/rounding.md has the reason).
double default_max_move(const Arrangement& arrangement);
/// Does the same for the largest coordinate, which is not negative.
double default_max_move(double largest);

/// Rounds an arrangement. Errors: interrupted, out_of_memory, bad_option (no doubles are within
/// max_move), bad_number (a constructed point is beyond the largest double), nothing_to_do (all
/// triangles vanished), internal. Times: round, with the step regions (intersection edges and
/// regions of the mesh; not rounding).
Result<RoundedMesh> round_to_doubles(const Arrangement& arrangement,
                                     const RoundingOptions& options = {}, const Run& run = {});

/// The constants that decide how contacts are repaired; they are documented in detail/tuning.hpp.
std::vector<NamedConstant> rounding_constants();

} // namespace terrane
