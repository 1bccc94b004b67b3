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

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

// Builds closed boundaries of a volume of interest: a box, a rotated box, a polygon between two
// depths, or any closed surface.
//
// Guarantee: a returned boundary has the role boundary, is closed (each edge has an even number of
// triangles) and meets itself only in shared vertices and edges, by exact predicates on its
// doubles. Faces of a rotated box need not be planar in doubles; nothing depends on that. Names:
// "boundary top", "boundary bottom", "boundary side 1", ...: one surface each, so that blocks and
// interfaces distinguish them. Sides are counterclockwise seen from above; side 1 lies between the
// first two corners (the last two of a clockwise polygon; for a box, at the least y). More than 12
// sides form one surface, "boundary sides". All surfaces are oriented outward. Cost: n log n,
// expected, for a polygon of n corners; the check takes one box search. Source: the paper, section
// 5.3 (volume of interest).

/// x and y, in the unit of the surfaces.
using Point2 = std::array<double, 2>;

/// A box in any direction. Lengths are in the unit of the surfaces, angles in degrees.
struct RotatedBox {
    Point3 place;                    ///< its centre
    bool is_corner = false;          ///< place is the corner that is lowest on all three edges
    std::array<double, 3> lengths{}; ///< of its edges, > 0: across, along, up
    double azimuth = 0;              ///< of the edges along: clockwise from y (north)
    double plunge = 0;               ///< of the edges along: downwards
    double roll = 0; ///< about the edges along: at 90, the edges across point down instead of right
};

/// Builds an axis-parallel box. Errors: bad_option (low is not below high in each coordinate),
/// bad_number.
Result<std::vector<Surface>> box_boundary(const Point3& low, const Point3& high);

/// Builds a rotated box. Errors: bad_option (a length is not positive), bad_number;
/// improper_contact if the box is too thin for doubles.
Result<std::vector<Surface>> rotated_box_boundary(const RotatedBox& box);

/// Builds the prism of a simple polygon, of either orientation, between two depths in either order.
/// The first corner may be repeated as the last. Errors: bad_option (fewer than three corners,
/// equal depths), bad_number; improper_contact if the polygon crosses or touches itself, with the
/// two edges by number, from 1.
Result<std::vector<Surface>> polygon_boundary(std::span<const Point2> corners, double low,
                                              double high);

/// Checks surfaces that are closed together and gives them the role boundary. Errors: nothing_to_do
/// (no triangle with area), bad_index, bad_number; not_closed with an edge at which an odd number
/// of triangles meet; improper_contact with the triangles and the place.
Result<std::vector<Surface>> closed_boundary(std::span<const Surface> surfaces,
                                             const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> boundary_constants();

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
