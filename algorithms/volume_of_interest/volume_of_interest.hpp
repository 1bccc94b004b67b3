// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Cuts surfaces by the closed boundary of a volume of interest and keeps the inside, exactly.
//
// The location of a triangle follows from the volumes of the whole arrangement (volumes.hpp): they
// are joined across all triangles that are not part of the boundary, which leaves the parts of
// space that the boundary alone separates. A part is inside if a path from the outside crosses the
// boundary an odd number of times; so a cavity of the boundary is outside. Guarantees: exact,
// without tolerance; the boundary is kept as a whole, with triangles of other surfaces that lie in
// it; the inside is closed: a block in it has all its faces. Cost: that of find_volumes(). Source:
// the paper, section 5.3 (volume of interest).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>

namespace terrane {

/// The location of a triangle with respect to a boundary.
enum class Where : std::uint8_t { outside, inside, boundary };

/// Locates each triangle of the arrangement. `boundary`: indices of the surfaces that bound the
/// volume, ascending. Triangles in them are `boundary`, whatever other surfaces they belong to.
/// Errors: those of find_volumes(); not_closed.
Result<std::vector<Where>> locate(const Arrangement& arrangement,
                                  std::span<const std::uint32_t> boundary, const Run& run = {});

/// The effect of the cut on one surface. Areas are in squared units, in floating point; they add up
/// to the area of the surface.
struct SurfaceCut {
    double area_inside = 0;       ///< squared unit
    double area_outside = 0;      ///< squared unit
    double area_on_boundary = 0;  ///< of the boundary's own faces, all of it
    std::size_t pieces = 0;       ///< parts of the kept surface, connected across edges
    double open_length = 0;       ///< of its borders that are free inside the volume
    std::size_t open_borders = 0; ///< connected ones of these
};

/// A border at which a surface ends inside the volume without meeting another one or the boundary.
struct OpenBorder {
    SurfaceId surface{}; ///< a triangle in several surfaces counts for each
    double length = 0;   ///< unit of the input
    Point3 place{};      ///< its lexicographically least vertex, rounded to doubles
};

/// The effects of a cut.
struct VolumeReport {
    std::vector<SurfaceCut> surfaces; ///< of the arrangement
    std::vector<OpenBorder> borders;  ///< by surface, then place; without the boundary's
};

/// The result of a cut.
struct VolumeOfInterest {
    Arrangement arrangement; ///< restricted to the inside and the boundary
    VolumeReport report;     ///< effects on surfaces and borders
};

/// Restricts the arrangement to the inside and the boundary. Errors: as locate().
Result<VolumeOfInterest> cut_to_volume(Arrangement arrangement,
                                       std::span<const std::uint32_t> boundary,
                                       const Run& run = {});

/// Finds the borders of surfaces that no other triangle meets, except for surfaces in `but`
/// (ascending).
std::vector<OpenBorder> open_borders(const Arrangement& arrangement,
                                     std::span<const std::uint32_t> but = {});

} // namespace terrane
