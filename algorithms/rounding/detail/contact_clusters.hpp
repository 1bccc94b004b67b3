// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the planes in which input triangles lie that are in contact and coplanar but for the error
// of doubles.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::rounding::detail {

/// Returns unit normals of planes in which doubles decide at random which point is above: at most
/// three, of which none is nearly in a plane with the others. They are, each time those of most
/// contacts first,
/// (1) those of clusters: two triangles in contact belong to one if no corner of the one is farther
///     than `tolerance` from the plane of the other, and its points must be as near to one plane; there
///     are none at all if these have less than cluster_share of the contacts in clusters;
/// (2) those of triangles that corners of others in contact touch, by the same measure;
/// (3) if there is any so far, those of other triangles in contact, and then of planes upright on
///     the first that contain edges in it: a lattice in the clusters is one along these, too.
/// corners: of the input triangles; points: that these name. Cost: linear in the contacts and in the input
/// triangles.
std::vector<Point3> cluster_directions(std::span<const Triangle> corners,
                                       std::span<const Point3> points,
                                       const ParentsInContact& in_contact, double tolerance);

/// Returns 2^digits times the spacing of doubles at a coordinate.
double spacing_at(double largest, int digits = 0);
/// Returns the tolerance of clusters. largest: the largest absolute coordinate of the input triangles.
double cluster_tolerance(double largest);

} // namespace terrane::rounding::detail
