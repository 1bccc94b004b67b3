// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Triangles seen along z, for the verifier: places, polygons and heights in rationals.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// A place in the plane, in the unit of scaled points.
struct Place {
    mpq_class x, y;
};

using PlacePolygon = std::vector<Place>; ///< convex, counterclockwise; empty: nothing
using SegmentInPlan = std::array<Place, 2>;

/// Three points with w = 1, counterclockwise seen from above.
using UpwardCorners = std::array<const Vector4*, 3>;

Place place_of(const Vector4& point); ///< Precondition: w = 1

/// Returns twice the area of a triangle, positive iff it is counterclockwise.
mpq_class turn(const Place& a, const Place& b, const Place& c);

/// Orders corners; `flipped` tells whether they were clockwise. None: the triangle is upright.
std::optional<UpwardCorners> upward(UpwardCorners corners, bool& flipped);

/// Tells whether the projections of two triangles have no common area.
bool are_beside(const UpwardCorners& s, const UpwardCorners& t);

/// Returns the common part of two projections.
PlacePolygon common_part(const UpwardCorners& s, const UpwardCorners& t);

/// Returns the height of the plane of a triangle over a place.
mpq_class height_over(const UpwardCorners& t, const Place& p);

/// Returns the point of the plane of a triangle over a place.
Vector4 point_over(const UpwardCorners& t, const Place& p);

/// Tells whether the projection of a triangle contains a place.
bool contains(const UpwardCorners& t, const Place& p);

/// Returns the mean of the corners.
Place mean_of(const PlacePolygon& polygon);

/// Tells whether a place is at most `width` away from a segment.
bool is_within(const Place& p, const SegmentInPlan& segment, const mpz_class& width);

/// Divides a polygon along the lines of those segments that pass through its interior, so that none
/// passes through the interior of a part. Precondition: the ends of each segment differ.
std::vector<PlacePolygon> divided_by(PlacePolygon polygon, std::span<const SegmentInPlan> segments);

} // namespace terrane::verifier
