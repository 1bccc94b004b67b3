// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Chooses a variogram for given data and calibrates it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::kriging::detail {

/// Validation of a model: blocks of data are left out and estimated from the others.
struct BlockValidation {
    std::size_t blocks = 0; ///< that could be left out
    double error = 0;       ///< root mean square
    double ratio = 0;       ///< root mean square over blocks of error / standard deviation, nugget
                            ///< included
    double noise_share = 1; ///< of the nugget that is noise
    double most = 0;        ///< largest square of that ratio of a block
    std::vector<std::array<double, 2>> left_out{}; ///< height of a datum, and as predicted
};

struct ModelChoice {
    Variogram variogram;    ///< nugget and sill are calibrated by the validation
    unsigned degree = 1;    ///< of the trend
    bool determined = true; ///< whether there are enough data to tell an expected error
    BlockValidation validation;
    std::optional<Variogram> plain{}; ///< if the variogram has anisotropy: the most likely one that
                                      ///< has none
    double doubt = 0; ///< share of the distance between the estimates of both that is expected as
                      ///< an error
};

/// Data and the hole among them.
struct DataAroundHole {
    std::span<const Point3> data; ///< those on the border of the hole first
    std::size_t border = 0;       ///< data on the border
    double radius = 0;            ///< of a disk with the area of the hole
};

/// Chooses the variogram that is most likely (restricted likelihood), of the models exponential,
/// matern and gaussian, or of options.model alone; the nugget among them is the noise of the data.
/// A gaussian model must be more likely by a margin, as must anisotropy. Then blocks as wide as the
/// hole are left out in turn: if they are missed by more than the model expects, nugget and sill
/// grow by the square of that ratio. The model counts for 2 blocks in it, and all blocks for at
/// most 12. If each of at least 8 blocks is missed by less than half of the error that the model
/// expects, nugget and sill shrink to the largest square of these ratios, but not below a quarter.
/// The trend has degree 1, or 2 if blocks are then missed by less than a tenth, or by little more
/// than noise. The data may have less noise than the least nugget that is tried: then the weights
/// of the data are smaller than it expects, and only that share of it is noise.
/// Stops early if the run is stopped; the choice is of no use then.
ModelChoice choose_model(const DataAroundHole& around, const VariogramFitOptions& options,
                         const Run& run);

} // namespace terrane::kriging::detail
