// SPDX-License-Identifier: LGPL-3.0-or-later
//
// TetGen's .poly and .smesh: surfaces as facets for `tetgen -pA`.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/region_point.hpp>

namespace terrane {

/// Points and facets count from 1, in the order of vertices and triangles; one triangle per facet.
/// The marker of a triangle of surface s alone is s + 1; sets of several surfaces have markers
/// after those, which comments explain. No holes; the points become region attributes. Numbers read
/// back as the same doubles.
std::string to_poly(const Mesh& mesh, std::span<const RegionPoint> regions = {});

/// The same in the shorter format, which has one polygon per facet.
std::string to_smesh(const Mesh& mesh, std::span<const RegionPoint> regions = {});

} // namespace terrane
