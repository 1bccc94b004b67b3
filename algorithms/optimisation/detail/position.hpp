// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Where a vertex among given faces makes the best tetrahedra.
#pragma once

#include <array>
#include <optional>

#include <terrane/algorithms/optimisation/detail/constants.hpp>
#include <terrane/algorithms/optimisation/detail/quality.hpp>

namespace terrane::optimisation::detail {

/// A place, and the least quality there.
struct Position {
    Point3 at;
    double quality = 0;
};

/// The directions in which places are looked for.
inline constexpr std::array<Point3, 14> directions{{{1, 0, 0},
                                                    {-1, 0, 0},
                                                    {0, 1, 0},
                                                    {0, -1, 0},
                                                    {0, 0, 1},
                                                    {0, 0, -1},
                                                    {.6, .6, .6},
                                                    {-.6, -.6, -.6},
                                                    {.6, .6, -.6},
                                                    {-.6, -.6, .6},
                                                    {.6, -.6, .6},
                                                    {-.6, .6, -.6},
                                                    {-.6, .6, .6},
                                                    {.6, -.6, -.6}}};

inline Point3 stepped(const Point3& from, double step, const Point3& direction) {
    return {from.x + step * direction.x, from.y + step * direction.y, from.z + step * direction.z};
}

/// Looks for a better place around the first one; it is no worse. Moves in fourteen directions are
/// tried, by smaller and smaller steps.
Position best_position(FacesAround& faces, const Point3& first);

/// Looks for a better place around where a vertex on walls is. `place` returns the place nearest to a
/// point where it may be, or none. It goes in the directions above, and away from the nearest vertex:
/// only that way is right if the two are very near. Steps become larger and larger, and end where tetrahedra are good
/// enough, so that it moves no farther than it must.
template <class Place>
Position near_position(FacesAround& faces, const Point3& first, double enough, const Place& place) {
    Position best{first, faces.least(first)};
    const auto away = faces.away_from_nearest(first);
    const double most = constants.largest_step * faces.farthest(first);
    double step = most * constants.first_small_step;
    const auto look = [&](const Point3& to) {
        const std::optional<Point3> p = place(to);
        if (!p) return;
        if (const auto quality = faces.above(*p, best.quality)) best = {*p, *quality};
    };
    for (; step <= most && best.quality < enough; step *= 2)
        for (unsigned n = 0; n < constants.steps_of_a_size; ++n) {
            const Position from = best;
            look(stepped(from.at, step, away));
            for (const Point3& d : directions) look(stepped(from.at, step, d));
            if (!(best.quality > from.quality)) break;
        }
    return best;
}

} // namespace terrane::optimisation::detail
