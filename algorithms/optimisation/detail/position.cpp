// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/detail/position.hpp>

#include <cmath>

#include <terrane/algorithms/optimisation/detail/constants.hpp>

namespace terrane::optimisation::detail {

Position best_position(FacesAround& faces, const Point3& first) {
    Position best{first, faces.least(first)};
    const double size = faces.nearest(first);
    if (!std::isfinite(size)) return best;
    double step = constants.first_step * size;
    for (unsigned halved = 0; halved < constants.step_halvings;) {
        const Position from = best;
        for (const Point3& d : directions) {
            const Point3 p = stepped(from.at, step, d);
            if (const auto quality = faces.above(p, best.quality)) best = {p, *quality};
        }
        if (best.quality > from.quality + constants.least_gain) continue;
        step /= 2;
        ++halved;
    }
    return best;
}

} // namespace terrane::optimisation::detail
