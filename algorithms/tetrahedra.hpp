// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Its own library, terrane::tetgen, since TetGen's licence (AGPL) is not that of the core.
#pragma once

#include <array>
#include <optional>

#include <terrane/algorithms/mesh.hpp>
#include <terrane/algorithms/result.hpp>
#include <terrane/algorithms/run.hpp>

namespace terrane {

/// Axis-aligned; low < high in each coordinate; unit of the mesh.
struct Box3 {
    Point3 low, high;
};

struct TetrahedraOptions {
    std::optional<Box3> box;       ///< closes the domain; must contain the mesh strictly inside
    double margin = 0.1;           ///< without a box: the bounding box, enlarged on each side by this
                                   ///< share of its longest edge
    std::optional<double> edge_length; ///< wanted length, unit of the mesh; none: as few as possible
    std::optional<double> radius_edge_ratio; ///< TetGen's quality bound (>= 1.1); none: no bound
    std::optional<double> max_volume; ///< of a tetrahedron, cubic unit
};

/// Tetrahedra of a box in which every triangle of the mesh is a union of faces.
/// The mesh must be conforming (see check): TetGen gets nothing else.
/// Errors: improper_contact with the place, bad_option, out_of_memory, internal.
/// Source: TetGen 1.5 (H. Si), called in process; its thrown ints become errors here.
/// TetGen keeps static state: calls are serialised by a mutex.
Result<TetrahedralMesh> tetrahedralize(const Mesh& mesh, const TetrahedraOptions& options,
                                       const Run& run);

} // namespace terrane
