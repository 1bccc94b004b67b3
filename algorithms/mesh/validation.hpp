// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stages validate their input here before they compute: coordinates are finite, corners name
// vertices and, where a stage needs it, triangles have an area. Cost: one pass over the arrays.
#pragma once

#include <cmath>
#include <span>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

inline bool is_finite(const Point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Checks surfaces for any stage: coordinates are finite and corners name vertices.
/// Errors, with the place of the first one: bad_number, bad_index; unsupported where indices would
/// not fit into 32 bits.
Status validate(std::span<const Surface> surfaces, const Run& run = {});

/// Checks triangles: coordinates of all points are finite and corners name points.
/// Errors, with the place of the first one: bad_number, bad_index.
Status validate(std::span<const Point3> points, std::span<const Triangle> triangles,
                const Run& run = {});

/// Checks triangles as validate does; moreover, each has an area, by an exact predicate.
/// Errors: as validate; improper_contact with the first triangle without area.
Status validate_areas(std::span<const Point3> points, std::span<const Triangle> triangles,
                      const Run& run = {});

/// Checks that each array of a mesh has its length, that all indices are below their counts, and
/// that coordinates are finite: each triangle has at least one surface, and a region in each of its
/// surfaces unless there are no regions at all. Errors, with the place of the first one:
/// bad_number, bad_index.
Status validate_indices(const Mesh& mesh, const Run& run = {});

/// Checks the arrays and indices of a mesh of tetrahedra likewise.
Status validate_indices(const TetrahedralMesh& mesh, const Run& run = {});

/// Checks a mesh as validate_indices does; moreover, each triangle has an area, by an exact predicate.
/// Errors: as validate_areas.
Status validate_mesh(const Mesh& mesh, const Run& run = {});

} // namespace terrane
