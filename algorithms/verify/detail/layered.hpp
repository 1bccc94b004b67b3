// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules R60 to R65 of the verifier: horizons that were put in order.
//
// The promise: at each place a layer has the height of its surface, except where this is above
// (below) the nearest harder layer that exists there and is higher (lower) in the order; then it
// has the height of that layer. The layers of the mesh are judged by it, seen along z. Let d be the
// stated deviation. Layers with a minimum thickness are moved apart: (4) then says less, and which
// height a layer has is not judged.
#pragma once

#include <span>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

/// Checks layers.
/// (1) R60: indices are in range, numbers are finite, d is not above the accepted one.
/// (2) R61: the mesh is conforming.
/// (3) R62: no layer is above one that is higher in the order. For two triangles of different
///     layers heights are compared at the corners of the common part of their projections. Exempt
///     is a common part within 2 d of a border of a surface, where a step can be.
/// (4) R63: each triangle of a layer is within d of its surface; or it belongs to a harder layer
///     that is higher (lower) in the order, too, and over each place of it the surface is not below
///     (above) it, unless the triangle is within d of the surface there, or the place within 2 d of
///     a border of a surface. For a triangle T of the layer and S of the surface, the distance of a
///     point of T from S is convex, and the places where S is below T are a half-plane; so the
///     corners of the common part decide. With a minimum thickness, each triangle is within d of its
///     surface, or of that of a harder layer moved along z by a multiple of the thickness.
/// (5) R64: a layer exists where its surface does, and nowhere else, except in strips as wide as
///     4 d along borders of surfaces. Each edge of the layer without a triangle on both sides is
///     within d of such borders. A triangle that faces aside, as in (6), covers no place or nearly
///     none; it counts on whichever side of its edges is free. The borders divide each triangle of the surface into convex cells. Where a
///     cell is more than d away from its border, the layer exists in all of it or nowhere; the mean
///     of its corners tells which, if that is more than 2 d away from the border.
/// (6) R65: each triangle faces up or down as one of the surfaces within d of it does. Exempt are
///     triangles that face aside: upright ones, and those with a corner within 2 d of the opposite
///     side in the projection, as rounding can turn them over.
///
/// From (3) to (5) the promise follows up to d: by (4) a layer has the height of its surface, which
/// is then between the nearest harder layers by (3); or that of a harder one, on whose wrong side
/// the surface is, and by (3) no other harder one is in between. Cost: O(n log n + k) for k pairs
/// of triangles of different layers near each other.
void check_layered(std::span<const Surface> surfaces, const LayeredClaim& layered, double accepted,
                   Violations& found);

} // namespace terrane::verifier
