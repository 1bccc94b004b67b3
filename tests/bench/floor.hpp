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

/// How much an arrangement of a model has to write.
struct OutputSize {
    std::size_t vertices = 0, triangles = 0;
};

/// Boxes of all triangles, one counting sort of them into such cells without any query, and output
/// arrays written: points, triangles, six lists of an entry for each triangle. A value that depends
/// on all.
std::size_t floor_of_arrange(const Model& m, const OutputSize& output);

} // namespace bench
