// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Exact volumes of blocks. Private to volumes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/volumes/detail/complex.hpp>

namespace terrane {

/// Volumes in front of and behind each triangle.
using VolumeSides = std::span<const std::array<std::uint32_t, 2>>;

/// Per volume the double nearest to its exact measure: sums of determinants with about 106 bits and
/// their error bounds, and the exact sum where those leave a doubt. [0] is what the other volumes
/// fill. To be called in the rounding mode "to nearest".
std::vector<double> measure_volumes(const TriangleComplex& sheets, VolumeSides of_sides,
                                    std::size_t count);

/// The exact ones as reduced fractions.
std::vector<std::string> exact_measures(const TriangleComplex& sheets, VolumeSides of_sides,
                                        std::size_t count, int base);

} // namespace terrane
