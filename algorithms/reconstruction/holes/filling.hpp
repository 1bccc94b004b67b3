// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane {

/// A surface that fills a hole.
struct Filling {
    Surface surface;           ///< name, role and orientation of the surface with the hole
    bool exact_border = false; ///< true: it covers the hole exactly, and its border is that of the
                               ///< hole, with bit-identical coordinates. false: it extends beyond
                               ///< the border on all sides and must be joined (join.hpp)
    std::vector<double>
        expected_error{}; ///< per vertex: expected error, >= 0; 0 on the border of the hole; NaN if
                          ///< unknown
    FillReport report{};  ///< how it was made
};

/// Computes the area of a surface.
inline double area_of(const Surface& s) {
    double sum = 0;
    for (const Triangle& t : s.triangles)
        sum += area_between(s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]);
    return sum;
}

} // namespace terrane
