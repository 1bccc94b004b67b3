// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Gaussian random fields of mean 0 and standard deviation 1 with a stated covariance, as functions of
// the place: a point has its value whatever other points there are, so that points at the same
// place, of one surface or of several, get the same value.
//
// The field is a sum of waves, sqrt(1/M) sum R_k cos(w_k p + a_k), with frequencies w_k drawn
// from the spectral density of the covariance, Rayleigh amplitudes R_k and uniform phases a_k
// (the randomisation method: Shinozuka and Jan 1972; Mantoglou and Wilson 1982). Laws:
// (1) the value at a point is exactly normal, whatever M;
// (2) over all streams the covariance of two points is exactly the stated one, whatever M;
// (3) for given frequencies it differs from it by a standard deviation of at most sqrt(1/(2 M)), .031 for
//     M = 512. So values at several points are a mixture of normal ones and not jointly
//     normal; mixtures differ little from their mean.
// Cost: M cosines per point. Cholesky's factor would make jointly normal values, but costs n^3, is
// singular where points coincide, and depends on all points of a surface.
#pragma once

#include <cstddef>
#include <vector>

#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>
#include <terrane/algorithms/uncertainty/random_stream.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// The number M of waves.
inline constexpr std::size_t field_waves = 512;

/// A realisation of a random field.
class GaussianField {
public:
    /// Draws a field. Of the variogram its model, range, exponent, angle and ratio count; sill and
    /// nugget do not. Precondition: the model is not power, which has no covariance.
    GaussianField(const Variogram& variogram, RandomStream stream, std::size_t waves = field_waves);

    /// Returns the value at a place. Distances along z count like those along x; for a function of the
    /// map, give z = 0.
    [[nodiscard]] double at(const Point3& p) const;

private:
    std::vector<double> x_, y_, z_; ///< frequencies per wave, in turns per unit of length
    std::vector<double> phase_;     ///< per wave, in turns
    std::vector<double> amplitude_; ///< per wave
    double cosine_ = 1, sine_ = 0;  ///< of the angle of the main direction
    double stretch_ = 1;            ///< of distances across it
};

} // namespace terrane
