// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Exact volumes of blocks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/volumes/complex.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::volumes {

/// The volumes in front of and behind each triangle.
using VolumeSides = std::span<const std::array<std::uint32_t, 2>>;

/// Returns, for each volume, the double nearest to its exact measure. Determinants are summed with
/// about 106 bits and an error bound; where this does not decide the rounding, the exact sum does.
/// [0] is the sum of all blocks. The rounding mode must be "to nearest".
std::vector<double> measure_volumes(const TriangleComplex& sheets, VolumeSides of_sides,
                                    std::size_t count);
/// The same of the triangles of an arrangement, whose volumes the caller numbered.
std::vector<double> measure_volumes(const Arrangement& arrangement, VolumeSides of_sides,
                                    std::size_t count);

/// Returns the planes of the triangles of an arrangement: those of their first parents, which are wound like them.
std::vector<Triangle> planes_of(const Arrangement& arrangement);

/// Finds volumes as find_volumes() does, without their measures, which are all 0.
Result<Volumes> find_unmeasured(const Arrangement& arrangement, const Run& run);
/// The same of a conforming mesh of doubles, but numbered by their first triangles.
Result<Volumes> find_sides(const Mesh& mesh, const Run& run);

/// Returns, for each volume, six times the part of its exact measure that these triangles
/// contribute, as text; all vertices are input points.
std::vector<std::string> partial_measures(const TriangleComplex& sheets, VolumeSides of_sides,
                                          std::size_t count);
/// Returns the double nearest to the measure whose parts are given.
double measure_of_parts(std::span<const std::string> parts);

/// Returns the exact measures as reduced fractions; [0] is the sum of all blocks.
std::vector<std::string> exact_measures(const TriangleComplex& sheets, VolumeSides of_sides,
                                        std::size_t count, int base);

} // namespace terrane::volumes
