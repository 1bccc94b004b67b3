// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What any method of filling a hole gives back.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// What was invented, and how far it can be trusted. Lengths in the unit of the surface.
struct FillReport {
    std::size_t data = 0;         ///< points of the surface that the filling was computed from
    std::size_t interpolated = 0; ///< vertices that the surface did not have
    double area = 0;              ///< of the triangles
    double expected_error = 0;    ///< root mean square of the deviations of invented vertices: what
                                  ///< the method itself predicts; NaN where it predicts nothing
    double validated_error = 0;   ///< root mean square of what the method misses when data are left
                                  ///< out and predicted from the others; NaN where not computed
    std::string model;            ///< in a sentence: what was fitted, with its numbers
};

/// A surface over a hole.
struct Filling {
    Surface surface;           ///< named as the surface with the hole; front on the same side
    bool exact_border = false; ///< true: it covers the hole and nothing else, and its border is the
                               ///< hole's, each vertex with the same coordinates to the last bit.
                               ///< false: it goes beyond the border on all sides and must be
                               ///< joined (join.hpp)
    std::vector<double>
        expected_error{}; ///< per vertex: expected error, >= 0; 0 on the border of the
                          ///< hole; NaN where not known
    FillReport report{};
};

} // namespace terrane
