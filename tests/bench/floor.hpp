// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The least work of any arrangement, in straight-line code: the floor with which times are
// compared.
#pragma once

#include <cstddef>

#include "models.hpp"

namespace bench {

/// Does the least work of the search: boxes of all triangles, one counting sort of the first
/// surface's boxes into cells as large as the largest box, one query by each of the second's.
/// Returns the number of overlapping pairs.
std::size_t floor_of_search(const Model& m);

/// The amount of output of an arrangement.
struct OutputSize {
    std::size_t vertices = 0, triangles = 0;
};

/// Does the least work of an arrangement: boxes of all triangles, one counting sort of them into
/// such cells without any query, and the output arrays: points, triangles, six lists with an entry
/// for each triangle. Returns a value that depends on all of them.
std::size_t floor_of_arrange(const Model& m, const OutputSize& output);

} // namespace bench
