// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <terrane/algorithms/arrangement/known_triangles.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>

namespace terrane {

/// Arranges as arrange_within() does, and shares what its arrangements find with others of the same
/// surfaces.
Result<Arranged> arrange_within(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                const ArrangeWithinOptions& options, KnownTriangles& known,
                                const Run& run);

} // namespace terrane
