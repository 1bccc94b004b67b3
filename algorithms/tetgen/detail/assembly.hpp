// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks a mesher's answer and turns it into the result.
#pragma once

#include <stop_token>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetgen/detail/process.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

namespace terrane::tetgen::detail {

/// The mesh without unused vertices, and the box around it: the domain that TetGen fills.
struct TetgenDomain {
    std::vector<Point3> points;      ///< used vertices of the mesh in its order, then 8 box corners
    std::vector<Triangle> triangles; ///< of the mesh, indices into points
    Box3 box;
};

/// Turns the answer of `mesher` into the tetrahedra of the mesh, with proof. The facets of `output` are
/// the triangles of the domain, then the sides of its box in the order low x, high x, low y, high
/// y, low z, high z. Errors: internal, if the result would break a guarantee of tetrahedralize();
/// interrupted.
Result<TetrahedralMesh> assemble(const Mesh& mesh, const TetgenDomain& domain, TetgenOutput output,
                                 const char* mesher = "TetGen", const std::stop_token& stop = {});

} // namespace terrane::tetgen::detail
