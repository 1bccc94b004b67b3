// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane {

/// Estimates how many points a filling of a hole has whose edges have this length: those of
/// equilateral triangles as large as the hole, and those along its border.
double expected_points(const BorderLoop& loop, double edge_length);

/// Refuses an edge length that asks for far more points than anybody could use. `edge_length`: 0
/// if the border decides. Errors: bad_option, with the number and the limit.
Status check_edge_length(const BorderLoop& loop, double edge_length);

} // namespace terrane
