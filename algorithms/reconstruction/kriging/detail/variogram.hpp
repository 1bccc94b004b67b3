// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How heights differ with distance: the experimental variogram of points, and models fitted to it.
// Source: Cressie, Statistics for Spatial Data (1993), 2.4 and 2.6.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane {

enum class VariogramModel : std::uint8_t { spherical, exponential, gaussian, power };

/// "spherical", ...
std::string_view name_of(VariogramModel model);

/// Half the mean squared difference of two heights at distance h > 0; 0 at h = 0:
///   spherical    nugget + sill (3/2 h/r - 1/2 (h/r)^3), and nugget + sill from r on
///   exponential  nugget + sill (1 - exp(-3 h/r))
///   gaussian     nugget + sill (1 - exp(-3 (h/r)^2))
///   power        nugget + sill (h/r)^exponent, r a fixed length
/// h is measured with geometric anisotropy: across the main direction distances count 1/ratio.
struct Variogram {
    VariogramModel model = VariogramModel::spherical;
    double nugget = 0;   ///< unit of z, squared; >= 0
    double sill = 0;     ///< the same, without the nugget; >= 0
    double range = 1;    ///< unit of x and y, along the main direction; > 0
    double exponent = 1; ///< power: in (0, 2)
    double angle = 0;    ///< degrees from x, counterclockwise: direction of the longest range
    double ratio = 1;    ///< range across it / range, in (0, 1]

    [[nodiscard]] double distance(double dx, double dy) const;
    /// At a distance > 0 that is measured so.
    [[nodiscard]] double at(double distance) const;
};

/// "gaussian model, range 1200, sill 64 and nugget 0.2; across 30 degrees 0.5 of it"
std::string description(const Variogram& variogram);

/// A class of pairs of points.
struct VariogramBin {
    double dx = 0, dy = 0; ///< the mean difference, in the half plane dx >= 0
    double distance = 0;   ///< the mean distance
    double gamma = 0;      ///< half the mean squared difference of heights
    std::size_t pairs = 0; ///< > 0
};

/// Classes by 15 distances and 12 directions, empty ones left out. `close` pairs are added to
/// all pairs of at most 1500 of the points, evenly chosen, which are no farther apart than
/// `longest`. Cost: about a million pairs at most, and the close ones.
std::vector<VariogramBin>
experimental_variogram(std::span<const Point3> points,
                       std::span<const std::array<std::uint32_t, 2>> close, double longest);

struct FitOptions {
    std::optional<VariogramModel> model{}; ///< none: the one that fits best
    double most_nugget =
        HUGE_VAL;           ///< unit of z, squared: what is known of the noise from elsewhere
    bool anisotropy = true; ///< looked for; taken where it makes the misfit a fifth smaller
};

/// Least squares, bins weighted by pairs / distance^2. Range, exponent and anisotropy by search,
/// nugget and sill exactly for each. Bins without any difference give sill 0.
Variogram fit_variogram(std::span<const VariogramBin> bins, const FitOptions& options = {});

} // namespace terrane
