// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Weighs models of the data around a hole.
//
// Models: a trend of degree 0 to 2 plus a Gaussian field with a covariance (variogram.hpp) plus
// noise of the data, the nugget; and the trend with noise alone. With few data round a hole several
// models are as likely, and in the middle of the hole they differ by more than any of them expects.
// So none is chosen: the estimate is their weighted mean, and its variance is the mean of theirs plus
// the variance between them.
// Source: Hoeting et al., Bayesian model averaging (1999); Harville (1977) for the likelihood;
// Yao et al. (2018) for weights by data left out; Chiles and Delfiner (2012), 3.4 and 4.6.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::kriging::detail {

struct WeighedModel {
    Variogram variogram; ///< sill 0: the trend and noise alone
    unsigned degree = 1; ///< of the trend
    double weight = 0;   ///< all are 1 together
};

/// Describes a model: "trend of degree 1, matern model, range ..."
std::string description(const WeighedModel& model);

/// Models with weights, and how they foretell blocks of data that are left out.
struct ModelAverage {
    std::vector<WeighedModel> models; ///< the likeliest first
    std::string unknown{};            ///< why no expected error can be told; empty: it can
    std::size_t blocks = 0;           ///< that could be left out
    double ratio = NAN;               ///< root mean square over blocks of error / expected error
    double error = NAN;               ///< root mean square over their data
    double rim_ratio = NAN; ///< error / expected error of a rim of data all round the hole
    double factor = 1;      ///< of standard deviations, for these ratios
    std::vector<std::array<double, 2>> left_out{}; ///< height of a datum, and as predicted
};

/// Data and the hole among them.
struct DataAroundHole {
    std::span<const Point3> data;   ///< those on the border of the hole first
    std::size_t border = 0;         ///< data on the border
    double radius = 0;              ///< of a disk with the area of the hole
    std::size_t near = data.size(); ///< data up to two radii away, which come first
};

/// Selects data.
std::vector<Point3> selected(std::span<const Point3> data, std::span<const std::uint32_t> chosen);

/// Weighs the likeliest model of each covariance of `options`, of the two likeliest with anisotropy,
/// and of noise about a trend:
///   (1) likelihood of 96 well-spread data near the hole, the neighbours of 48 of them, and 24 data
///       farther away, after the trend has been taken out by contrasts, with the likeliest range,
///       nugget and sill. A term of the trend costs what spreading its factor over the variance of
///       the heights does. The logarithm is divided by 2;
///   (2) blocks as wide as the hole, round places of its border, are left out of the data near the
///       hole in turn. The mean
///       logarithm of the density that a model expects of a datum in them counts as much as blocks
///       are, but at most 8 of them, since they overlap;
///   (3) models below a hundredth have no say;
///   (4) `factor` is the ratio of what the average misses of the blocks and what it expects;
///   (5) rims of data all round the hole are left out, as if it were wider by up to half of its
///       radius: where they are missed by more, the surface becomes rougher or steeper towards the
///       hole, and may do so again within it. So `factor` is the square of that ratio, if that is more.
/// Stops early if the run is stopped; the result is of no use then.
/// Cost: 4/3 n^3 for n = 168 and each of 40 to 90 shapes, with all trends; n^3 for n = 250 and each of
/// at most 12 models.
ModelAverage weigh_models(const DataAroundHole& around, const KrigingOptions& options,
                          const Run& run);

} // namespace terrane::kriging::detail
