// SPDX-License-Identifier: LGPL-3.0-or-later
//
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
#pragma once

#include <array>
#include <span>
#include <vector>

#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

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

/// Builds the prism of a simple polygon, of either orientation, between two depths in either order. The
/// last corner may repeat the first.
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

} // namespace terrane
