// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which parts of strips close a gap, exactly. Private to sealing.
//
// The cells of a strip are the parts into which the curves with other surfaces cut its pieces (one
// for each edge of the border, and fans). A cell is kept if one can come to it from the border
// within the strip, over kept cells, and it nowhere ends free beyond: its edges lie on the border,
// on another triangle that is kept, or on the side of its piece. So a strip goes to the first
// surfaces that close it off, and not beyond.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>

namespace terrane {

/// Which strip triangle each input triangle is, or UINT32_MAX. The strips were appended in order
/// (append_strips), and stand last in each surface.
std::vector<std::uint32_t> strips_by_input(const Arrangement& arrangement,
                                           std::span<const ExtensionTriangle> strips);

/// Triangles of the arrangement all whose parents are strips: that of the first one, else
/// UINT32_MAX.
std::vector<std::uint32_t> strips_by_triangle(const Arrangement& arrangement,
                                              std::span<const std::uint32_t> by_input);

/// Per triangle whether it is kept. `keep` says it for triangles that are no strips.
std::vector<bool> kept_cells(const Arrangement& arrangement,
                             std::span<const ExtensionTriangle> strips, std::vector<bool> keep);

} // namespace terrane
