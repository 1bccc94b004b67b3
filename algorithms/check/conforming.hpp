// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Done where the triangles are a conforming mesh, by exact predicates on the doubles: every two
/// share a vertex, an edge, or nothing; none is degenerate or repeated; no two vertices in use are
/// at one place. label_of: per triangle, any; triangles that hang together and have the same one
/// are tried as a whole, see patches.hpp.
/// Errors: bad_number, bad_index; improper_contact with the first place where it is not;
/// interrupted. Cost: that of find_injective_patches, then a box search and one test per pair of boxes.
Status conforming(std::span<const Point3> points, std::span<const Triangle> triangles,
                  std::span<const std::uint32_t> label_of, const Run& run = {});

} // namespace terrane
