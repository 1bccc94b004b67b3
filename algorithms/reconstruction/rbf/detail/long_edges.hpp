// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Adds points on the long edges of a surface around a hole.
#pragma once

#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>

namespace terrane::rbf::detail {

/// Bisects edges longer than `limit`, both of whose ends are within `near` of the border,
/// repeatedly, and subdivides their triangles. A surface is more than its vertices: a function that
/// interpolates these alone may deviate far from the long triangles of a cliff and then can't be
/// joined to them. The surface does not change, and stays conforming; points keep their order
/// (distances are set, normals are not). Cost: linear in the data if no edge is long.
void divide_long_edges(RbfData& data, double limit, double near);

} // namespace terrane::rbf::detail
