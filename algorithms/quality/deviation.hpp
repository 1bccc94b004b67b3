// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How far surfaces are apart, measured: by code that shares nothing with what improves a mesh.
#pragma once

#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The largest distance to `to` of the corners, the middles of edges and seven inner points of the
/// triangles of `from`: no more than the one-sided Hausdorff distance. Unit of the points, in
/// floating point; infinite where `to` has no triangles. Cost: 13 searches in a tree per triangle.
double sampled_distance(const Surface& from, const Surface& to, const Run& run = {});

/// No less than the one-sided Hausdorff distance, but for rounding, and at most `tolerance` more.
/// Cost: triangles are divided until their size or what is known of them is below the tolerance:
/// for small ones.
double distance_bound(const Surface& from, const Surface& to, double tolerance,
                      const Run& run = {});

/// The triangles of a mesh that are part of a surface, with vertices of their own.
Surface surface_of_mesh(const Mesh& mesh, std::uint32_t surface);

/// Sampled distances of one surface in two meshes: from the second to the first, and back.
struct Deviation {
    double out = 0, back = 0;
};

/// Per surface; both meshes have the same surfaces.
std::vector<Deviation> deviations_of(const Mesh& before, const Mesh& after, const Run& run = {});

} // namespace terrane
