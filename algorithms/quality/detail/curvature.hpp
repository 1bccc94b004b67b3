// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures how much a surface turns, over lengths as large as the wanted edges.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/quality/detail/features.hpp>

namespace terrane::quality::detail {

/// Computes, per vertex, the largest turn of its sheets per length, in radians per unit of length.
/// A vertex has the mean normal and the centre, both weighted by area, of the triangles of a sheet
/// within half of `reach` of it, or of those at it where triangles are larger. It is compared with
/// the vertices of the sheet about half of `reach` away, or with its neighbours. So the slivers
/// along intersections, which have hardly any area, do not matter. `reach` is given per vertex.
/// Cost: the number of triangles within that distance, at most turn_triangles, per vertex.
std::vector<double> turns_per_length(const Mesh& mesh, const Features& features,
                                     std::span<const double> reach);

} // namespace terrane::quality::detail
