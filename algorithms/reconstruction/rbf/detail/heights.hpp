// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fits a surface that is a graph over a plane: f(p) = w - g(u, v), with g a sum of kernels of the
// distance in the plane and a polynomial. So f is a height above the surface and needs no constraints
// off the surface, a third of those in space.
//
// Steps:
//   (1) centres: all data; if there are more than are allowed, half of them those nearest to the
//       border, the others well spread;
//   (2) kernel: of h, h^2 log h and h^3 the one that is most likely for well-spread data (restricted
//       likelihood, Harville 1977). Its nugget is the noise of single data, which g leaves out;
//   (3) degree: with h^3, a polynomial of higher degree if the data next to the hole, left out at
//       once as if it were wider by a quarter of its radius, are then missed by a tenth less;
//   (4) g, from all centres by one Cholesky factor of the contrasts.
// Invariant under the order of the data, and under rotations about w, flips, units and shifts, to
// rounding. Cost: n^3 / 3 for n centres. Source: Wahba (1990), 1 and 2; Chiles and Delfiner (2012), 4,
// for the likelihood of generalised covariances.
#pragma once

#include <array>
#include <optional>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/fit.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::rbf::detail {

/// A fitted graph.
struct HeightFit {
    Implicit f;
    RbfKernel kernel = RbfKernel::cubic;
    double noise = 0;     ///< standard deviation of single data that g leaves out
    double validated = 0; ///< root mean square error of blocks left out; NaN if there were none
};

/// Returns the direction along which the data are a graph, to either side: z if they are one along
/// z, otherwise the third one of axes_of(); none if they are no graph along that either.
std::optional<std::array<Point3, 3>> graph_axes(const RbfData& data);

/// Fits a graph by steps (1) to (4), and interpolates what it misses of the data unless
/// options.smoothing is set. None if the data are no graph after all, as two of them are above each
/// other, or if the run is stopped.
std::optional<HeightFit> fit_heights(const RbfData& data, const std::array<Point3, 3>& axes,
                                     const RbfOptions& options, RbfReport& report, const Run& run);

} // namespace terrane::rbf::detail
