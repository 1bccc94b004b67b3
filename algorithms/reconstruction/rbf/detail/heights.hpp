// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fits a surface that is a graph over a plane: f(p) = w - g(u, v), with g a sum of kernels of the
// distance in the plane and a polynomial. So f is a height above the surface and needs no
// constraints off the surface, a third of those in space.
//
// Steps:
//   (0) directions: where the model of kriging for the same data has anisotropy, u and v are
//       stretched by it, so that kernels follow grooves (not if the surface is infinitely smooth,
//       as polynomials follow that);
//   (1) centres: all data; if there are more than are allowed, half of them those nearest to the
//       border, the others well spread;
//   (2) kernel: of h, h^2 log h and h^3 the one that is most likely for well-spread data
//       (restricted likelihood, Harville 1977). Its nugget is the noise of single data, which g
//       leaves out;
//   (3) degree: with h^3, a polynomial of higher degree if the data next to the hole, left out at
//       once as if it were wider by a quarter of its radius, are then missed by a tenth less, and
//       blocks as wide as the hole, left out in turn, not by more;
//   (4) g, from all centres by one Cholesky factor of the contrasts.
// Invariant under the order of the data, and under rotations about w, flips, units and shifts, to
// rounding. Cost: n^3 / 3 for n centres. Source: Wahba (1990), 1 and 2; Chiles and Delfiner (2012),
// 4, for the likelihood of generalised covariances.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/height_errors.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/fit.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/height_system.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::rbf::detail {

/// A fitted graph.
struct HeightFit {
    Implicit f;
    std::array<Point3, 3> axes{};
    RbfKernel kernel = RbfKernel::cubic;
    double noise = 0; ///< standard deviation of single data that g leaves out
    double validated = std::numeric_limits<
        double>::quiet_NaN(); ///< root mean square error of blocks left out; NaN if there were none
    std::vector<std::array<double, 2>> left_out; ///< FillReport::left_out
    std::optional<HeightSystem> known;   ///< of the centres, scaled, with the noise of the data
    std::optional<HeightSystem> some;    ///< the same of fewer, well-spread centres
    double sill = 0;                     ///< factor of its kernel
    double noise_share = 1;              ///< of its nugget that is noise of the data
    double rounding = 0;                 ///< least expected error
    std::optional<HeightErrors> kriging; ///< by another model of the data
    bool believed = true;                ///< rather than that other model
};

/// Returns the direction along which the data are a graph, to either side: z if they are one along
/// z, otherwise the third one of axes_of(); none if they are no graph along that either.
std::optional<std::array<Point3, 3>> graph_axes(const RbfData& data);

/// Fits a graph by steps (1) to (4). None if the data are no graph after all, as two of them are
/// above each other, or if the run is stopped.
std::optional<HeightFit> fit_heights(const RbfData& data, const std::array<Point3, 3>& axes,
                                     const RbfOptions& options, RbfReport& report, const Run& run);

/// Interpolates what a graph misses of the data, unless options.smoothing is set.
void interpolate_noise(HeightFit& fit, const RbfData& data, const RbfOptions& options,
                       RbfReport& report, const Run& run);

/// Computes the heights of a graph along z at the x and y of places. Cost: n for each, for n
/// centres.
std::vector<double> heights_of(const HeightFit& fit, std::span<const Point3> places,
                               const Run& run);

/// Computes the expected error of heights: the root of the variance that a model leaves given the
/// data, plus the square of the distance from what it estimates. The model is one of kriging, which
/// knows more of ranges and directions. It is that of the fit, its kernel being a generalised
/// covariance with the most likely factor, where kriging misses blocks as wide as the hole by half
/// as much again, with noise or beyond it, and the fit's noise is at most twice that of kriging. Noise of the data does not
/// count, but where the level follows it, that does. Cost: n^2 for each height and n centres.
std::vector<double> expected_errors(const HeightFit& fit, std::span<const Point3> points,
                                    const Run& run);

} // namespace terrane::rbf::detail
