// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Where a vertex among given faces makes the best tetrahedra.
#pragma once

#include <terrane/algorithms/optimisation/detail/quality.hpp>

namespace terrane::optimisation::detail {

/// A place, and the least quality there.
struct Position {
    Point3 at;
    double quality = 0;
};

/// Looks for a better place around the first one; it is no worse. Moves in fourteen directions are
/// tried, by smaller and smaller steps.
Position best_position(FacesAround& faces, const Point3& first);

} // namespace terrane::optimisation::detail
