// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces of quadrilaterals, such as grids of horizons, in an arrangement.
// (2a) Inclusion: a quadrilateral that an intersection curve meets is divided along the curve, into
//      triangles. All others stay whole. The cells are conforming: two of them share a vertex, an
//      edge, or nothing.
// (2b) Diffusion: regions spread over the edges of the cells and stop at the curve.
// Guarantee: a region of cells covers the same triangles as a region of find_regions().
// Cost: linear in the triangles, and sorting their edges. Source: the paper, section 3, and its
// remark that both steps extend to quadrilateral meshes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/input_triangles.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

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
