// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divides faces of files, which may have any number of corners, into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// What is wrong with a face that was divided into triangles.
enum class FaceFlaw : std::uint8_t {
    none,
    crosses, ///< it crosses or touches itself, so its triangles are a fan round its first corner
    bent     ///< it has more than four corners, and one is off its plane by a hundredth of its size
};

/// Appends triangles that cover a face as its border says, seen along the axis nearest to its
/// normal, and that face the same side. Where the fan round the first corner does, it is these. Otherwise
/// they are a constrained Delaunay triangulation. A border may run to a hole and back on the same
/// way (a keyhole). Fewer than three corners have no triangles. Cost: linear for a fan, that of
/// triangulate_inside (planar.hpp) otherwise.
/// Precondition: corners are indices of finite points.
FaceFlaw append_face(std::span<const Point3> points, std::span<const std::uint32_t> corners,
                     std::vector<Triangle>& triangles);

} // namespace terrane
