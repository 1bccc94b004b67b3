// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The least that any arrangement has to do, in straight-line code: what others are measured by.
#pragma once

#include <cstddef>

#include "models.hpp"

namespace bench {

/// The search part: boxes of all triangles, one counting sort of the first surface's into cells as
/// large as the largest box, one query by each of the second's. The number of overlapping pairs.
std::size_t floor_of_search(const Model& m);

/// Boxes of all triangles, one counting sort of them into such cells without any query, and the
/// output arrays written: points and triangles copied, six lists filled. A value that depends on
/// all.
std::size_t floor_of_arrange(const Model& m);

} // namespace bench
