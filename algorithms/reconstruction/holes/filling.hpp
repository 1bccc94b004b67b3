// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The result of filling a hole, whatever the method.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Describes a filling and how far it can be trusted. Lengths are in the unit of the surface.
struct FillReport {
    std::size_t data = 0;         ///< points of the surface used as data
    std::size_t interpolated = 0; ///< vertices that the surface did not have
    double area = 0;              ///< of the triangles
    double expected_error = 0;    ///< root mean square of Filling::expected_error over the
                                  ///< interpolated vertices; NaN if the method predicts none
    double validated_error = 0;   ///< root mean square error at data that were left out and
                                  ///< predicted from the others; NaN if not computed
    std::string model;            ///< the fitted model and its parameters, in a sentence
    std::vector<std::array<double, 2>>
        variogram{}; ///< of kriging, without the trend: mean distance, half the mean squared
                     ///< difference of heights; ascending; empty: there is none
    std::vector<std::array<double, 2>> variogram_model{}; ///< the fitted one, likewise
    std::vector<std::array<double, 2>>
        left_out{}; ///< height of a datum, and as the data outside of its block predict it, for
                    ///< validated_error; empty: none were left out. Heights are along z, or, of a
                    ///< surface that is no graph z = f(x, y), along the mean normal of the border
};

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

} // namespace terrane
