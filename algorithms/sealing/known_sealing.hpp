// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <terrane/algorithms/arrangement/known_triangles.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>

namespace terrane {

/// Seals as seal() does, and shares what its arrangements find with others of the same surfaces.
Result<Sealed> seal(std::vector<Surface> surfaces, const SealOptions& options,
                    KnownTriangles& known, const Run& run);

} // namespace terrane
