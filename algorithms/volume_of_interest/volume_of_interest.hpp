// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces cut by the closed boundary of a volume of interest: the inside is kept, exactly.
//
// Where a triangle lies: the volumes of the whole arrangement (volumes.hpp) are found and joined
// across all triangles that are not of the boundary; what is left are the parts of space that the
// boundary alone leaves. A part is inside if one crosses the boundary an odd number of times on the
// way there from the outside. So a cavity of the boundary is outside.
// Guarantees: exact, no tolerance; the boundary is kept whole, with triangles of other surfaces
// that lie in it; the inside is closed: a block of it has all its faces.
// Cost: that of find_volumes.
// Source: the paper, section 5.3 (volume of interest).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>

namespace terrane {

/// Where a triangle lies with respect to a boundary.
enum class Where : std::uint8_t { outside, inside, boundary };

/// Where each triangle of the arrangement lies. `boundary`: indices of the surfaces that bound the
/// volume, ascending. Triangles in it are `boundary`, whatever other surface they belong to.
/// Errors: those of find_volumes; not_closed.
Result<std::vector<Where>> locate(const Arrangement& arrangement,
                                  std::span<const std::uint32_t> boundary, const Run& run = {});

/// What the cut does to one surface. Areas in squared units, in floating point; they add up to the
/// area of the surface.
struct SurfaceCut {
    double area_inside = 0;       ///< squared unit
    double area_outside = 0;      ///< squared unit
    double area_on_boundary = 0;  ///< of the boundary's own faces, all of it
    std::size_t pieces = 0;       ///< connected over edges, of what is kept
    double open_length = 0;       ///< of its borders that are free inside the volume
    std::size_t open_borders = 0; ///< connected ones of these
};

/// Where a surface ends inside the volume, without meeting another one or the boundary.
struct OpenBorder {
    std::uint32_t surface = 0; ///< of a triangle in several surfaces each has one
    double length = 0;         ///< unit of the input
    Point3 place{};            ///< its lexicographically least vertex, to the nearest double
};

/// What the cut did to each surface.
struct VolumeReport {
    std::vector<SurfaceCut> surfaces; ///< of the arrangement
    std::vector<OpenBorder> borders;  ///< by surface, then place; not of the boundary
};

/// The inside of a boundary.
struct VolumeOfInterest {
    Arrangement arrangement; ///< restricted to what is inside and to the boundary
    VolumeReport report;     ///< what was cut
};

/// Keeps what is inside and the boundary. Errors: as locate.
Result<VolumeOfInterest> cut_to_volume(Arrangement arrangement,
                                       std::span<const std::uint32_t> boundary,
                                       const Run& run = {});

/// The borders of surfaces that no other triangle meets, but for surfaces in `but` (ascending).
std::vector<OpenBorder> open_borders(const Arrangement& arrangement,
                                     std::span<const std::uint32_t> but = {});

} // namespace terrane
