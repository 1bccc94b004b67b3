// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Limits the tolerance of remeshing where blocks are thin.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>

namespace terrane::quality::detail {

/// Computes, per triangle, the least of the bound of its sheet and `share` times the distance to the
/// next triangle in front of it or behind it, along its normal at four of its points. Triangles with
/// a common corner do not count, nor do those beyond the bound divided by the share. Empty if no
/// triangle is limited. The values are a choice, no part of a proof: they are computed in
/// floating point. Cost: a search for pairs of boxes.
std::vector<double> bounds_by_thickness(const Mesh& mesh, const Features& features,
                                        std::span<const double> bound_of, double share,
                                        const Run& run);

/// Computes, per vertex, the tolerance of curves: the least of the triangles at it, times the share
/// that curves have (constants.hpp). Empty if `bound_of_triangles` is.
std::vector<double> bounds_of_vertices(const Features& features, std::size_t vertices,
                                       std::span<const double> bound_of_triangles);

} // namespace terrane::quality::detail
