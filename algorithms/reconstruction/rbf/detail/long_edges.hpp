// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Points on the long edges of a surface round a hole. Private to rbf.
#pragma once

#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>

namespace terrane {

/// Halves edges that are longer than `limit`, both ends not farther from the border than `near`,
/// again and again, and divides their triangles by the new points. A surface is more than its
/// vertices: what meets these alone may swing far from a cliff's triangles, which are long, and
/// then can't be joined along them. The surface stays as it is, and conforming where it was; points
/// keep their order (distances; normals are not made). Cost: linear in the data where no edge is
/// long.
void divide_long_edges(RbfData& data, double limit, double near);

} // namespace terrane
