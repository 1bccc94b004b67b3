// SPDX-License-Identifier: LGPL-3.0-or-later
//
// TetGen's .poly and .smesh, with surfaces as facets for `tetgen -pA`.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Writes points and facets, numbered from 1, in the order of vertices and triangles; each facet is
/// one triangle. A triangle that belongs to surface s only has the marker s + 1; each set of
/// several surfaces has a larger marker of its own, which a comment explains. There are no holes;
/// `points` become region attributes. Numbers read back as the same doubles.
std::string to_poly(const Mesh& mesh, std::span<const BlockPoint> points = {});

/// Writes the same as to_poly in the shorter format, which has one polygon per facet.
std::string to_smesh(const Mesh& mesh, std::span<const BlockPoint> points = {});

} // namespace terrane
