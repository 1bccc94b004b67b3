// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Builds bridges: bands of triangles between two borders that face each other, with corners at
// vertices of both, so that they end exactly on both.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>
#include <terrane/algorithms/sealing/detail/facing_borders.hpp>
#include <terrane/algorithms/sealing/detail/gap_distances.hpp>

namespace terrane::sealing::detail {

/// Triangles between borders, and the gaps that they close.
struct Bridges {
    std::vector<ExtensionTriangle> triangles{};
    std::vector<Gap> gaps{};        ///< by piece, from the first one on
    std::vector<bool> is_bridged{}; ///< per edge of the borders
};

/// Builds bridges where whole border edges face each other. A bridge begins at a shortest way
/// between ends of two edges that do, and goes on to both sides, triangle by triangle, each on one
/// border edge, always the one whose new side is shorter. Lengths and corners decide, in this
/// order, so the result does not depend on the order of surfaces and edges, unless two surfaces
/// have the same border vertices. A bridge between two surfaces belongs to that one at which the
/// lesser end of its first way lies. Pieces are numbered from `first_piece` on, one per edge of
/// that surface. Of the gaps, `to` is the surface on the other side.
Bridges make_bridges(const Arrangement& arrangement, const FacingBorders& borders,
                     std::uint32_t first_piece);

} // namespace terrane::sealing::detail
