// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Decides whether the triangles of a filling are small enough to represent a curved surface.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/reconstruction/holes/detail/constants.hpp>

namespace terrane::detail {

/// How often a default mesh size may be halved.
constexpr unsigned most_halvings = holes::detail::constants.most_halvings;

/// Selects at most `most` inner edges (edges of two triangles), evenly spaced in ascending order.
std::vector<Edge> some_inner_edges(std::span<const Triangle> triangles, std::size_t vertices,
                                   std::size_t most);

double root_mean_square(std::span<const double> values);

/// Tells whether smaller triangles would bring a filling nearer to the truth. `sags` are the
/// distances of the interpolating function from the midpoints of edges, `expected` its own expected
/// errors there. True if the root mean square of the sags exceeds that of the expected errors, and
/// also rounding: a millionth of `size`, the edge length. False if an expected error is unknown or
/// there are no edges.
bool flatness_outweighs(std::span<const double> sags, std::span<const double> expected,
                        double size);

} // namespace terrane::detail
