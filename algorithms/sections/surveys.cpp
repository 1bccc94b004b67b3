// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Paths of wells from deviation surveys.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/sections/sections.hpp>

namespace terrane {
namespace {

constexpr double degree = std::numbers::pi / 180;

Status check_stations(std::span<const WellStation> stations) {
    const auto refused = [](std::string sentence) {
        return Error{ErrorCode::bad_option, std::move(sentence), "survey"};
    };
    if (stations.empty()) return refused("needs a station");
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const auto& [depth, inclination, azimuth] = stations[i];
        const auto at = [&](const char* sentence) {
            return refused(sentence + (": station " + std::to_string(i + 1)));
        };
        if (!std::isfinite(depth) || !std::isfinite(inclination) || !std::isfinite(azimuth))
            return at("numbers are finite");
        if (depth < 0) return at("depths are not below 0");
        if (i > 0 && !(depth > stations[i - 1].depth)) return at("depths ascend");
        if (inclination < 0 || inclination > 180) return at("inclinations are from 0 to 180");
    }
    return Done{};
}

/// Returns (x, y, -z) of the chord between two stations, of which the second is deeper; not finite if they point
/// against each other.
Point3 chord(const WellStation& a, const WellStation& b) {
    const double i = a.inclination * degree, j = b.inclination * degree;
    const double s = a.azimuth * degree, t = b.azimuth * degree;
    const double turn = std::pow(std::sin((j - i) / 2), 2) +
                        std::sin(i) * std::sin(j) * std::pow(std::sin((t - s) / 2), 2);
    const double half = std::asin(std::sqrt(std::clamp(turn, 0.0, 1.0))); // of the angle between
    constexpr double least = 1e-4; // below it the series is exact in doubles
    const double ratio = half < least ? 1 + half * half / 3 : std::tan(half) / half;
    const double scale = (b.depth - a.depth) / 2 * (turn < 1 - 1e-15 ? ratio : HUGE_VAL);
    return {scale * (std::sin(i) * std::sin(s) + std::sin(j) * std::sin(t)),
            scale * (std::sin(i) * std::cos(s) + std::sin(j) * std::cos(t)),
            scale * (std::cos(i) + std::cos(j))};
}

} // namespace

Result<WellPath> surveyed_path(std::string name, const Point3& head,
                               std::span<const WellStation> stations) {
    return guarded("for the survey", "surveyed_path", [&]() -> Result<WellPath> {
        if (!is_finite(head))
            return Error{ErrorCode::bad_option, "the head of a well is finite", "survey"};
        if (const auto sound = check_stations(stations); !sound) return sound.error();
        WellPath path{std::move(name), {head}, {0}};
        WellStation last{0, 0, stations[0].azimuth};
        if (stations[0].depth == 0) last = stations[0];
        for (const WellStation& station : stations) {
            if (station.depth == 0) continue;
            const Point3 step = chord(last, station), &p = path.points.back();
            const Point3 next{p.x + step.x, p.y + step.y, p.z - step.z};
            if (!is_finite(next))
                return Error{ErrorCode::bad_option, "two stations point against each other",
                             "survey"};
            path.points.push_back(next);
            path.depths.push_back(station.depth);
            last = station;
        }
        return path;
    });
}

} // namespace terrane
