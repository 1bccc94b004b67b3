// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Decides exactly which parts of strips close a gap. Internal; shared by sealing and the extension
// to the boundary of a volume.
//
// The cells of a strip are the parts into which the curves with other surfaces cut its pieces (one
// piece per border edge, and fans). A cell is kept if it is connected to the border within the
// strip, across kept cells, and has no free edge: each of its edges lies on the border, on another
// triangle that is kept, or on the side of its piece. Connected cells must end on a surface
// somewhere, or be a bridge between two parts of the border of their own: other strips that lead
// from the border of their surface to its border close no gap. So a
// strip extends to the first surfaces that close it off, and not beyond. The result depends on no
// order: statement (1) of docs/explanation/sealing.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>

namespace terrane {

/// Returns for each input triangle its strip triangle, or UINT32_MAX. The strips must have been
/// appended in order by append_strips(), so that they come last in each surface.
std::vector<std::uint32_t> strips_by_input(const Arrangement& arrangement,
                                           std::span<const ExtensionTriangle> strips);

/// Returns for each triangle of the arrangement all of whose parents are strips the first of these,
/// otherwise UINT32_MAX.
std::vector<std::uint32_t> strips_by_triangle(const Arrangement& arrangement,
                                              std::span<const std::uint32_t> by_input);

/// Decides which triangles are kept. `keep` gives the decision for triangles that are not strips.
std::vector<bool> kept_cells(const Arrangement& arrangement,
                             std::span<const ExtensionTriangle> strips, std::vector<bool> keep);

} // namespace terrane
