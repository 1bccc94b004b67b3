// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The regions into which intersection edges divide each surface.
// Guarantees: each triangle of a surface is in exactly one region of that surface; two triangles
// are in the same region iff a path across edges that are not intersection edges connects them.
// Regions are numbered by surface, then by lowest triangle.
// Cost: linear. Source: the paper, section 3, step 2b (diffusion over edges, stopped at the curve).
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// A part of a surface that hangs together without crossing an intersection edge.
struct Region {
    SurfaceId surface{};                   ///< the surface that it is part of
    std::uint32_t first_triangle = 0;      ///< the lowest triangle of the region
    std::size_t triangles = 0;             ///< number of triangles
    double area = 0;                       ///< in squared units of the input; floating point
    std::vector<std::uint32_t> neighbours; ///< regions of any surface that share an intersection
                                           ///< edge with it, ascending
};

/// The regions of all surfaces.
struct Regions {
    IndexLists<std::uint32_t> regions_of; ///< per triangle, parallel to surfaces_of
    std::vector<Region> regions;          ///< by surface, then by lowest triangle
};

/// Finds the regions of a mesh. Its intersection_edges separate them; its regions_of is ignored.
Regions find_regions(const Mesh& mesh, const Run& run = {});

} // namespace terrane
