// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which variogram and trend to use for some data. Private to filling.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>

namespace terrane::detail {

/// What a model misses where whole patches of data are left out.
struct BlockValidation {
    std::size_t count = 0;
    double error = 0;    ///< root mean square
    double expected = 0; ///< the same of the deviations, with the nugget
};

struct ModelChoice {
    Variogram variogram; ///< sill and nugget scaled so that `error` is what was expected
    unsigned degree = 1; ///< of the trend
    BlockValidation blocks;
};

/// Fits each model to the data without a trend of degree 1 and 2, with a nugget of at most `noise`
/// and without one, isotropic; a gaussian one without nugget also with twice and four times the
/// range, the same near h = 0. Of these it takes the one that misses least when patches, each a
/// tenth of at most 150 data, are left out and estimated from the others; but no gaussian one that
/// misses more than half of what another does, and no nugget left out or trend of degree 2 for less
/// than a fifth: these can go astray in a hole wider than the patches. Then with anisotropy, if
/// that misses less. `close`, `longest`: as experimental_variogram.
ModelChoice choose_model(std::span<const Point3> data,
                         std::span<const std::array<std::uint32_t, 2>> close, double longest,
                         double noise, const FitOptions& options);

} // namespace terrane::detail
