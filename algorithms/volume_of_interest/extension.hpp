// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Extends horizons that end inside a volume of interest to its boundary.
//
// Beyond each free border inside the volume, a strip of new triangles continues along the border's
// tangent plane, as far as the limit; the cut (volume_of_interest.hpp) ends it exactly at the
// boundary. Where it crosses other surfaces, it is cut like any horizon that crosses faults. Its
// direction is averaged along half the limit of the border, and farther where strips of rough
// borders would fold; corners are mitred. All surfaces are extended except boundaries and faults,
// which may end anywhere. A border edge whose strip does not leave the volume within the limit is
// not extended, but listed; that is decided exactly. If a strip leaves a volume that is not convex
// and enters it again within the limit, a loose piece remains there. Cost: two arrangements and two
// cuts. Source: the paper, section 5.3 (volume of interest).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// Options of extend_to_boundary().
struct ExtendOptions {
    double limit = 0; ///< > 0, unit of the input: largest width of strips, except at corners
    ArrangeOptions arrange{}; ///< for the arrangements that are made
};

/// A connected part of a border inside the volume.
struct ExtendedBorder {
    SurfaceId surface{};   ///< of the input
    bool reached = false;  ///< whether it reached the boundary and was extended
    double length = 0;     ///< of the free border; unit of the input
    Point3 place{};        ///< its lexicographically least vertex
    std::size_t edges = 0; ///< border edges of the input
};

/// Surfaces extended to a boundary.
struct Extended {
    std::vector<Surface> surfaces;       ///< those of the input; triangles of strips come last in
                                         ///< each
    std::vector<ExtendedBorder> borders; ///< by surface, then place
};

/// Extends surfaces to the boundary. `boundary`: indices in `surfaces` of those that bound the
/// volume, ascending. Errors: bad_option (the limit is not positive), those of arrange() and
/// cut_to_volume().
Result<Extended> extend_to_boundary(std::vector<Surface> surfaces,
                                    std::span<const std::uint32_t> boundary,
                                    const ExtendOptions& options, const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> extension_constants();

} // namespace terrane
