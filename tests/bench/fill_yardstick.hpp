// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills a hole with CGAL (GPL, so that only benchmarks are linked with it).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace fill_bench {

/// Fills the hole with this border; the new triangles come last. Returns none where CGAL fails.
/// `fair`: triangulate_refine_and_fair_hole; otherwise triangulate_hole, a plain linear patch.
std::optional<terrane::Surface> filled_by_cgal(const terrane::Surface& surface,
                                               const std::vector<std::uint32_t>& border, bool fair);

} // namespace fill_bench
