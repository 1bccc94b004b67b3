// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The zero level of a function of space as triangles, near given points: marching tetrahedra on the
// cubes of a lattice that the level crosses, from the seeds on from cube to cube; then thinned,
// swapped and smoothed to triangles of one size.
//
// Why this routine: marching tetrahedra have no ambiguous case, so the result is a manifold without
// degenerate triangles for any function, by construction, each triangle within its own tetrahedron.
// What they lack, good shapes, thinning and smoothing give. CGAL's surface mesher is GPL, and VTK's
// dual methods ask for a whole grid where a band is wanted. The level need not be exact: joining
// is, for any surface that comes out here. Cost: the function at about six lattice points per
// vertex of the result, and a few times at each vertex. Source: Doi and Koide (1991) for the
// tetrahedra; Hart (1992), 2.3, for steps onto a level.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// A smooth function of space. Called from several threads.
struct SpaceFunction {
    std::function<double(const Point3&)> value;
    std::function<Point3(const Point3&)> gradient;
};

struct ZeroLevelOptions {
    double size = 0; ///< length of the edges aimed at, unit of the points; > 0
    std::span<const Point3>
        seeds; ///< where the level is to be found; others are reached from there
    std::function<bool(const Point3&)> leave; ///< cubes whose middle is such a point are left out
    std::size_t most_cubes = 4'000'000;
};

/// Front where the function is positive. Consistently oriented; each edge has one or two triangles.
/// Errors: bad_option (size, or a lattice too fine for its extent), nothing_to_do (no level near
/// the seeds), unsupported (more cubes than allowed), interrupted.
Result<Surface> zero_level(const SpaceFunction& function, const ZeroLevelOptions& options,
                           const Run& run = {});

} // namespace terrane
