// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Holes of a surface z = f(x, y) filled by kriging. Source: the paper, section 5.1.
#pragma once

#include <cstddef>
#include <span>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/holes/filling.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/variogram.hpp>

namespace terrane {

struct KrigingOptions {
    FitOptions variogram{};
    double mesh_size = 0;  ///< of the filling, unit of x and y; 0: the median edge of the hole's
                           ///< border, down to a quarter where flat triangles of that size would
                           ///< miss more than the heights themselves are expected to
    std::size_t rings = 5; ///< of triangles round the hole whose corners are data; >= 1
    std::span<const BorderLoop> loops{}; ///< all of the surface: parts of it that lie within the
                                         ///< hole are data too, and left out of the filling
};

/// The filling of a hole, with its exact border: the border's vertices bit by bit, between them a
/// constrained Delaunay triangulation seen along z with vertices a mesh size apart, their heights
/// by kriging (see kriging.hpp) from the corners of the rings round the hole. Where more than
/// 20 000 vertices would be needed the mesh grows coarser away from the border.
///
/// Exact: the triangles of the filling are strictly on the other side of each border edge than the
/// surface, seen along z, and do not overlap. (What else of the surface is above or below is not
/// looked at.)
/// Cost: linear in the surface; n log n in what is invented, and the cost of Kriging.
/// Errors: unsupported where the surface is no graph z = f(x, y) round the hole, with the place;
/// bad_option, bad_number, bad_index; nothing_to_do for a loop without area; interrupted.
Result<Filling> fill_by_kriging(const Surface& surface, const BorderLoop& loop,
                                const KrigingOptions& options = {}, const Run& run = {});

/// The surface with a filling that has its exact border: old vertices and triangles first,
/// unchanged, then the new ones. The filling's border finds its vertices by their coordinates.
Surface joined(const Surface& surface, const Filling& filling);

} // namespace terrane
