// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Triangulates the zero level of a function of space near given points: marching tetrahedra on the
// cubes of a lattice that the level crosses, followed from the seeds from cube to cube; the mesh is
// then thinned, swapped and smoothed to triangles of one size.
//
// Marching tetrahedra have no ambiguous case, so for any function the result is a manifold without
// degenerate triangles, each within its own tetrahedron. Thinning and smoothing provide the good
// shapes that they lack. CGAL's surface mesher is GPL, and VTK's dual methods need a whole grid
// instead of a band. The level need not be exact, as joining is exact for any surface. Cost: the
// function at about six lattice points per vertex of the result, and a few times at each vertex.
// Source: Doi and Koide (1991) for the tetrahedra; Hart (1992), 2.3, for steps to a level.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::rbf::detail {

/// A smooth function of space. It is called from several threads.
struct SpaceFunction {
    std::function<double(const Point3&)> value;
    std::function<Point3(const Point3&)> gradient;
};

struct ZeroLevelOptions {
    double size = 0; ///< target edge length, unit of the points; > 0
    std::span<const Point3>
        seeds; ///< points near which the level starts; the rest is followed from there
    std::function<bool(const Point3&)> leave; ///< cubes whose centre satisfies this are omitted
    std::size_t most_cubes = 4'000'000;
};

/// Triangulates the zero level; the front is where the function is positive. The result is oriented
/// consistently, and each edge has one or two triangles. Errors: bad_option (size, or a lattice too
/// fine for its extent), nothing_to_do (no level near the seeds), unsupported (more cubes than
/// allowed), interrupted.
Result<Surface> zero_level(const SpaceFunction& function, const ZeroLevelOptions& options,
                           const Run& run = {});

} // namespace terrane::rbf::detail
