// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Models how heights differ with distance: the experimental variogram of points and theoretical
// variograms. Source: Cressie, Statistics for Spatial Data (1993), 2.4 and 2.6.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// Half the mean squared difference of two heights at distance h > 0, for range r; 0 at h = 0:
///   spherical    nugget + sill (3/2 h/r - 1/2 (h/r)^3), and nugget + sill from r on
///   exponential  nugget + sill (1 - exp(-3 h/r))
///   gaussian     nugget + sill (1 - exp(-3 (h/r)^2))
///   power        nugget + sill (h/r)^exponent, r a fixed length
///   matern       nugget + sill (1 - (1 + a) exp(-a)), a = 4.744 h/r, for exponent 1.5, or
///                nugget + sill (1 - (1 + a + a^2/3) exp(-a)), a = 5.919 h/r, for exponent 2.5
///   thin plate   nugget - sill (h/r)^2 log(h/r), r a fixed length
///   cubic        nugget - sill (h/r)^3, r a fixed length
/// The last two are minus generalised covariances, for a trend of degree 1 or more; their surfaces
/// have least bending energy, and one derivative more. All but spherical and power reach 95 %
/// of the sill at the range. Surfaces have one derivative with matern and exponent 1.5, two with 2.5,
/// none with spherical and exponential, all with gaussian. h is measured with geometric anisotropy:
/// distances across the main direction are divided by the ratio.
struct Variogram {
    VariogramModel model = VariogramModel::spherical; ///< the shape
    double nugget = 0;                                ///< unit of z, squared; >= 0
    double sill = 0;     ///< without the nugget; unit of z, squared; >= 0
    double range = 1;    ///< unit of x and y, along the main direction; > 0
    double exponent = 1; ///< power model: in (0, 2); matern: smoothness, 1.5 or 2.5
    double angle = 0;    ///< main direction: degrees from x, counterclockwise
    double ratio = 1;    ///< range across it / range, in (0, 1]

    /// The length of a difference in x and y, with anisotropy.
    [[nodiscard]] double distance(double dx, double dy) const;
    /// Evaluates the variogram at a distance > 0 that was computed by distance().
    [[nodiscard]] double at(double distance) const;
};

/// The least degree of a trend with which a model's variogram is minus a covariance.
inline unsigned least_degree(VariogramModel model) {
    return model == VariogramModel::thin_plate || model == VariogramModel::cubic ? 1 : 0;
}

/// Describes a variogram: "gaussian model, range 1200, sill 64, nugget 0.2; longest at 30 degrees
/// from x, 0.5 of it across"
std::string description(const Variogram& variogram);

/// Computes the experimental variogram in 15 classes of the distance of a variogram, up to `longest`:
/// per class with pairs, their mean distance and half their mean squared difference of heights. Pairs
/// are all those of at most 1500 points, evenly spaced. Cost: about a million pairs at most.
std::vector<std::array<double, 2>> experimental_variogram(std::span<const Point3> points,
                                                          const Variogram& model, double longest);

} // namespace terrane
