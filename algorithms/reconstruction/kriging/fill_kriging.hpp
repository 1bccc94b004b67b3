// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills holes of a surface z = f(x, y) by kriging. Source: the paper, section 5.1.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/holes/filling.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>

namespace terrane {

/// Options of fill_by_kriging().
struct KrigingOptions {
    std::optional<VariogramModel> model{}; ///< none: all that are described there
    bool anisotropy = true;                ///< models with directions take part
    std::optional<double> noise{}; ///< standard deviation of single data; none: as is likeliest
    double mesh_size = 0;  ///< of the filling, unit of x and y; 0: the median edge of the hole's
                           ///< border, down to a quarter of it if flat triangles of that size would
                           ///< be farther from the estimated heights than their expected error
    std::size_t rings = 5; ///< rings of triangles around the hole whose corners are data, at least;
                           ///< more up to two radii of the hole, until there are 4000 data, and
                           ///< farther away until there are 800; >= 1
    std::span<const BorderLoop> loops{}; ///< all loops of the surface: parts within the hole are
                                         ///< data, too, and are left out of the filling
};

/// Fills a hole exactly up to its border. The filling has the border vertices, bit by bit, and
/// between them a constrained Delaunay triangulation in x and y with vertices a mesh size apart,
/// whose heights are the average of several models (detail/average.hpp), estimated by kriging from
/// the corners of the rings around the hole. Where more
/// than 20 000 vertices would be needed, the mesh becomes coarser away from the border.
///
/// Exact: seen along z, the triangles of the filling do not overlap, and at each border edge they
/// lie strictly on the other side than the surface. (Other parts of the surface above or below are
/// not examined.)
/// Cost: linear in the surface, n log n in the interpolated vertices, and the cost of the models.
/// Errors: unsupported if the surface around the hole is no graph z = f(x, y), with the place;
/// bad_option, bad_number, bad_index; nothing_to_do for a loop without area; interrupted.
Result<Filling> fill_by_kriging(const Surface& surface, const BorderLoop& loop,
                                const KrigingOptions& options = {}, const Run& run = {});

/// Joins a filling that has the exact border to the surface: its vertices and triangles come first,
/// unchanged, then the new ones. Border vertices are identified by their coordinates.
Surface joined(const Surface& surface, const Filling& filling);

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> kriging_constants();

} // namespace terrane
