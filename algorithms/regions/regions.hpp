// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The regions into which intersection edges divide each surface.
// Guarantees: each triangle of a surface is in exactly one region of that surface; two triangles
// are in the same region iff a path across edges that are not intersection edges connects them.
// Regions are numbered by surface, then by lowest triangle.
// Cost: linear. Source: the paper, section 3, step 2b (diffusion over edges, stopped at the curve).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

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

// Surfaces of quadrilaterals, such as grids of horizons, in an arrangement.
// (2a) Inclusion: a quadrilateral that an intersection curve meets is divided along the curve, into
//      triangles. All others stay whole. The cells are conforming: two of them share a vertex, an
//      edge, or nothing.
// (2b) Diffusion: regions spread over the edges of the cells and stop at the curve.
// Guarantee: a region of cells covers the same triangles as a region of find_regions().
// Cost: linear in the triangles, and sorting their edges. Source: the paper, section 3, and its
// remark that both steps extend to quadrilateral meshes.

/// The corners of a quadrilateral in order around it, as indices into vertices.
using Quadrilateral = std::array<std::uint32_t, 4>;

/// A surface of quadrilaterals. Their corners need not lie in a plane.
struct QuadSurface {
    std::string name;                 ///< need not be unique
    Role role = Role::unknown;        ///< as in Surface
    std::vector<Point3> vertices;     ///< in the unit of the model
    std::vector<Quadrilateral> quads; ///< indices into vertices
};

/// Returns the surface as triangles: quadrilateral q becomes the triangles 2 q and 2 q + 1, on both
/// sides of its diagonal from corner 0 to corner 2.
Surface triangles_of(const QuadSurface& surface);

/// The cells of one surface of quadrilaterals in a mesh, and their regions.
struct QuadCells {
    IndexLists<std::uint32_t> cells;      ///< per cell: its corners in order around it, vertices of
                                          ///< the mesh; four of a whole quadrilateral, or three
    std::vector<std::uint32_t> quad_of;   ///< per cell: the quadrilateral that contains it
    std::vector<std::uint32_t> region_of; ///< per cell; regions are numbered by their first cells
    std::uint32_t regions = 0;            ///< number of regions
};

/// Finds the cells of a surface of quadrilaterals in a mesh. The mesh is a rounded arrangement in
/// which the surface took part as triangles_of() it; `inputs` is the numbering of that arrangement.
/// Cells are in the order of their first triangles. Where two quadrilaterals coincide, the cells
/// are those of the first. Errors: bad_index (there is no such surface); nothing_to_do (the mesh
/// has no parents); unsupported (the surface has an odd number of triangles).
Result<QuadCells> quad_cells(const Mesh& mesh, const InputTriangles& inputs, SurfaceId surface);

} // namespace terrane
