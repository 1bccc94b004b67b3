// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Chooses variogram and trend for given data.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>

namespace terrane::kriging::detail {

/// Validation of a model: patches of data are left out and estimated from the others.
struct BlockValidation {
    std::size_t count = 0;
    double error = 0;    ///< root mean square
    double expected = 0; ///< root mean square of the standard deviations, nugget included
};

struct ModelChoice {
    Variogram variogram; ///< sill and nugget are scaled so that `error` was to be expected
    unsigned degree = 1; ///< of the trend
    BlockValidation blocks;
};

/// Fits each model to the residuals of trends of degree 1 and 2, isotropic, with a nugget of at
/// most `noise` and without; a gaussian model without nugget also with two and four times the range
/// and the same shape near h = 0. Chooses the one with the least validated error when patches, each
/// a tenth of at most 150 data, are left out. A gaussian model must have less than half of the
/// others' error, a model without nugget or with a trend of degree 2 less than four fifths of it,
/// as these can be far off in holes wider than the patches. Finally tries anisotropy, which is kept
/// if it reduces the error. `close` and `longest` are those of experimental_variogram().
ModelChoice choose_model(std::span<const Point3> data,
                         std::span<const std::array<std::uint32_t, 2>> close, double longest,
                         double noise, const VariogramFitOptions& options);

} // namespace terrane::kriging::detail
