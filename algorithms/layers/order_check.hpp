// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks exactly that no layer of a mesh is anywhere above a layer that is higher in the order. The
// check knows nothing of hardness or of how the layers were made: it clips the projections of two
// triangles in rationals and compares heights at the corners of their common polygon. Cost: the
// search for pairs of boxes, and some microseconds for each pair near each other.
#pragma once

#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Finds the pairs of triangles that are out of order. The surfaces of the mesh are the layers,
/// from the top down. Upright triangles cover no place and are skipped, and so are common polygons
/// within `step_width` of a border edge of one of the two layers, where rounding moves the sides of
/// a step across each other. Sorted by the layers, then by the triangles. Errors: interrupted.
Result<std::vector<OutOfOrder>> find_out_of_order(const Mesh& mesh, double step_width,
                                                  const Run& run = {});

} // namespace terrane
