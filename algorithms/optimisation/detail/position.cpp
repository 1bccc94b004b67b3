// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/detail/position.hpp>

#include <array>
#include <cmath>

#include <terrane/algorithms/optimisation/detail/constants.hpp>

namespace terrane::optimisation::detail {

namespace {

constexpr std::array<Point3, 14> directions{{{1, 0, 0},
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

} // namespace

Position best_position(FacesAround& faces, const Point3& first) {
    Position best{first, faces.least(first)};
    const double size = faces.nearest(first);
    if (!std::isfinite(size)) return best;
    double step = constants.first_step * size;
    for (unsigned halved = 0; halved < constants.step_halvings;) {
        const Position from = best;
        for (const Point3& d : directions) {
            const Point3 p{from.at.x + step * d.x, from.at.y + step * d.y, from.at.z + step * d.z};
            if (const auto quality = faces.above(p, best.quality)) best = {p, *quality};
        }
        if (best.quality > from.quality + constants.least_gain) continue;
        step /= 2;
        ++halved;
    }
    return best;
}

} // namespace terrane::optimisation::detail
