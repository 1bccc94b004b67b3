// SPDX-License-Identifier: LGPL-3.0-or-later
//
// CGAL's ways of filling a hole (GPL: linked into benchmarks only).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace fill_bench {

/// The surface with the hole with this border filled, new triangles last; none where CGAL does not.
/// `fair`: triangulate_refine_and_fair_hole; else triangulate_hole, a plain linear patch.
std::optional<terrane::Surface> filled_by_cgal(const terrane::Surface& surface,
                                               const std::vector<std::uint32_t>& border, bool fair);

} // namespace fill_bench
