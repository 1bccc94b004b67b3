// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on arranged and rounded surfaces.
#pragma once

#include <cstddef>
#include <string>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Adds counts and times of all steps to `statistics`.
void add_statistics(Json& statistics, const Arranged& arranged, const Inputs& inputs);

/// Reports the surfaces with their triangles, regions and areas, the triangles set aside, and the
/// rounding.
std::string summary(const Inputs& inputs, const Arranged& arranged);

/// Reports the rounding of a mesh, and whether its doubles are verified.
std::string text_of(const RoundingReport& rounding, const Quantities& quantities);

/// Lists the pairs of triangles that the rounding left in improper contact, by name; 20 at most.
std::string offending_pairs(const Inputs& inputs, const Arranged& arranged);

/// Counts the flaws that an exact check finds once the coordinates are float32, as in binary STL.
std::size_t float32_flaws(const Mesh& mesh, const Run& run);

} // namespace terrane::cli
