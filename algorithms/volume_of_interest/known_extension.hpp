// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/known_triangles.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace terrane {

/// Extends as extend_to_boundary() does, and shares what its arrangements find with others of the
/// same surfaces.
Result<Extended> extend_to_boundary(std::vector<Surface> surfaces,
                                    std::span<const std::uint32_t> boundary,
                                    const ExtendOptions& options, KnownTriangles& known,
                                    const Run& run);

} // namespace terrane
