// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Horizons that end inside a volume of interest, extended to its boundary.
//
// Beyond each free border inside the volume a strip of new triangles goes on along the border's
// tangent plane, as far as the limit; the cut (volume_of_interest.hpp) ends it exactly at the
// boundary. It crosses whatever is in its way, as a horizon crosses faults: the arrangement sees to
// that. Directions are means along half the limit of the border, and farther where strips of rough
// borders would fold; at corners the strip is mitred.
// All surfaces are extended but faults, which may end anywhere, and boundaries. A border edge whose
// strip does not come out of the volume within the limit is left as it is, and listed; that is
// decided exactly.
// A strip that leaves a volume which is not convex, and comes back into it within the limit, leaves
// a loose piece there.
// Cost: two arrangements and two cuts.
// Source: the paper, section 5.3 (volume of interest).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// Options of extend_to_boundary().
struct ExtendOptions {
    double limit = 0;         ///< > 0, unit of the input: no strip is wider, but at corners
    ArrangeOptions arrange{}; ///< for the arrangements that are made
};

/// A connected part of a border inside the volume.
struct ExtendedBorder {
    std::uint32_t surface = 0; ///< of the input
    bool reached = false;      ///< the boundary: it was extended
    double length = 0;         ///< of the free border; unit of the input
    Point3 place{};            ///< its lexicographically least vertex
    std::size_t edges = 0;     ///< border edges of the input
};

/// Surfaces extended to a boundary.
struct Extended {
    std::vector<Surface> surfaces;       ///< of the input; triangles of strips stand last in each
    std::vector<ExtendedBorder> borders; ///< by surface, then place
};

/// `boundary`: indices of the surfaces that bound the volume, ascending; they are among `surfaces`.
/// Errors: bad_option (the limit is not positive), those of arrange and cut_to_volume.
Result<Extended> extend_to_boundary(std::vector<Surface> surfaces,
                                    std::span<const std::uint32_t> boundary,
                                    const ExtendOptions& options, const Run& run = {});

} // namespace terrane
