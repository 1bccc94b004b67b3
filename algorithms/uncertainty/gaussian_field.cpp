// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/gaussian_field.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <terrane/kernel/assertion.hpp>

namespace terrane {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// Returns the squared length of `n` normal numbers.
double chi_square(RandomStream& stream, int n) {
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double g = stream.normal();
        sum += g * g;
    }
    return sum;
}

/// Draws the length u of a wave vector from the density c (sin u - u cos u)^2 / u^4, that of the
/// spherical covariance of range 2 in space: it is the convolution of a ball with itself. Proposals
/// have the density of |Cauchy|, 2/pi / (1 + u^2); the ratio of the two is largest, 1.2846, near 2.66.
double spherical_frequency(RandomStream& stream) {
    constexpr double bound = 1.29, small = 1e-3;
    for (;;) {
        const double across = stream.normal(), u = std::fabs(stream.normal() / across);
        const double accept = stream.uniform();
        if (!(u < 1e12)) continue; // the density beyond it is below 1e-12
        // cos u and sin u = cos(u - a quarter of a turn)
        const double t = u / full_turn;
        const double f = cos_of_turns(t - 0.25) / u - cos_of_turns(t);
        const double density = u < small ? u * u / 9 : f * f / (u * u);
        if (accept * bound < density * (1 + u * u)) return u;
    }
}

/// Returns the factor by which a normal vector becomes a frequency, in radians per range.
double normal_scale(const Variogram& v, RandomStream& stream) {
    // A wave vector of the Matern covariance is normal, divided by the root of chi^2 / (2 nu), and by
    // the length l of exp(-h/l), (1 + a) exp(-a), a = sqrt(3) h/l, ... (Variogram has a of h and r).
    switch (v.model) {
    case VariogramModel::gaussian:
        return std::sqrt(6.0); // exp(-3 h^2) has l^2 = 1/6
    case VariogramModel::exponential:
        return 3 / std::sqrt(chi_square(stream, 1));
    default:
        break;
    }
    const bool smooth = v.exponent == 2.5;
    const double steepness = smooth ? 5.919 : 4.744; // a / (h/r)
    return steepness / std::sqrt(chi_square(stream, smooth ? 5 : 3));
}

} // namespace

GaussianField::GaussianField(const Variogram& variogram, RandomStream stream, std::size_t waves) {
    TERRANE_ASSERT(variogram.model != VariogramModel::power);
    cosine_ = cos_of_turns(variogram.angle / 360);
    sine_ = cos_of_turns(variogram.angle / 360 - 0.25);
    stretch_ = 1 / variogram.ratio;
    const double share = std::sqrt(1 / static_cast<double>(waves));
    for (std::size_t k = 0; k < waves; ++k) {
        const std::array w{stream.normal(), stream.normal(), stream.normal()};
        double scale = 0;
        if (variogram.model == VariogramModel::spherical) {
            const double length = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
            scale = 2 * spherical_frequency(stream) / length; // the ball has the radius range / 2
        } else {
            scale = normal_scale(variogram, stream);
        }
        // A coordinate times the frequency must keep bits behind the point; such waves are noise.
        scale = std::min(scale / (full_turn * variogram.range), 1e6 / variogram.range);
        x_.push_back(w[0] * scale);
        y_.push_back(w[1] * scale);
        z_.push_back(w[2] * scale);
        phase_.push_back(stream.uniform());
        amplitude_.push_back(share * std::sqrt(-2 * portable_log(stream.uniform())));
    }
}

double GaussianField::at(const Point3& p) const {
    const double along = cosine_ * p.x + sine_ * p.y;
    const double across = stretch_ * (cosine_ * p.y - sine_ * p.x);
    // Eight sums at a time fit vector registers; their order is fixed.
    constexpr std::size_t lanes = 8;
    std::array<double, lanes> sums{};
    const std::size_t n = phase_.size(), whole = n - n % lanes;
    const auto term = [&](std::size_t k) {
        return amplitude_[k] *
               cos_of_turns(x_[k] * along + y_[k] * across + z_[k] * p.z + phase_[k]);
    };
    for (std::size_t k = 0; k < whole; k += lanes)
        for (std::size_t i = 0; i < lanes; ++i) sums[i] += term(k + i);
    for (std::size_t k = whole; k < n; ++k) sums[k - whole] += term(k);
    double sum = 0;
    for (const double part : sums) sum += part;
    return sum;
}

} // namespace terrane
