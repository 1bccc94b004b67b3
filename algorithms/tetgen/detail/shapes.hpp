// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Better shapes for the tetrahedra that a mesher made.
#pragma once

#include <optional>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/optimisation/optimise.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tetgen::detail {

/// Improves tetrahedra that fill the volumes of a mesh, as far as the options ask for it; where they
/// bound volumes, no tetrahedron becomes larger than those around it. None: they do not ask for it.
/// Precondition: check_tetrahedra() finds nothing. Errors: those of optimise() and sizes_of().
Result<std::optional<OptimiseReport>> improve_shapes(TetrahedralMesh& tetrahedra, const Mesh& mesh,
                                                     const Volumes& volumes,
                                                     const TetrahedraOptions& options,
                                                     const Run& run);

} // namespace terrane::tetgen::detail
