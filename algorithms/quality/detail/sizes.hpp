// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Computes the target edge lengths and the tolerances of remeshing.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/quality/improve.hpp>

namespace terrane::quality::detail {

struct Sizes {
    std::vector<double> of_vertices; ///< per vertex: target length of its edges
    std::vector<double> bound_of;    ///< per sheet: largest deviation
};

/// options.edge_length_of must have one element per surface, or none.
Sizes find_sizes(const Mesh& mesh, const Features& features, const ImproveOptions& options);

/// Limits each target length to that of a neighbour plus `growth` times the distance to it.
void limit_growth(std::span<const Point3> points, std::span<const Triangle> triangles,
                  double growth, std::vector<double>& sizes);

/// Estimates the number of triangles from areas and local target lengths.
double expected_with_sizes(const Mesh& mesh, const Features& features, const Sizes& sizes);

} // namespace terrane::quality::detail
