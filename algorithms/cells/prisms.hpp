// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Prisms between two surfaces, on the triangles of the upper one.
//
// (1) The nodes lie on the verticals through the vertices of the top. Which triangle of the base the vertical meets is
//     decided exactly; the node on the base is the double nearest to the exact height. At a vertical fault, where the
//     vertical meets two triangles in different heights, each triangle of the top has the one on its own side.
// (2) A layer without thickness at one of three corners makes a pyramid, at two a tetrahedron, at all three no cell.
// (3) Cells share nodes where they meet, so that they conform; along a vertical fault with throw they slide past each
//     other, as the surfaces do.
// (4) The volumes of all cells add up exactly to that between the top and the nodes on the base. The base itself is met
//     at the nodes; between them it may bend away from the prisms.
// Triangles of the top are left out, and named, if the base is missing below one of their corners, or above it.
// Cost: linear in the triangles, and in those of the base whose boxes in the map contain a vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// What layers follow.
enum class PrismLayers : std::uint8_t {
    proportional, ///< each vertical is divided evenly
    top, ///< layers of one thickness below the top; the base cuts them, and the last one has the rest
    base, ///< layers of one thickness above the base; the top cuts them, and the first one has the rest
};

/// How to divide the space between two surfaces.
struct PrismOptions {
    std::uint32_t layers = 1;                       ///< number of layers, from 1 to 10 000
    PrismLayers follow = PrismLayers::proportional; ///< what they follow
    double thickness =
        0; ///< of a layer, in the unit of the surfaces; > 0 if they follow the top or the base, else 0
};

/// Why no prism stands on a triangle of the top.
struct PrismGap {
    std::uint32_t triangle = 0; ///< of the top
    std::uint32_t corner = 0;   ///< 0, 1 or 2: the first where it is so
    bool is_crossed = false;    ///< the base is above the top there; otherwise it is missing
};

/// A prism, pyramid or tetrahedron.
struct PrismCell {
    /// 6 nodes: the lower triangle, counterclockwise from above, then the upper one. 5: a quadrilateral,
    /// counterclockwise from the last node. 4: the first three are counterclockwise from the last.
    std::array<std::uint32_t, 6> nodes{};
    std::uint8_t size = 6;      ///< nodes in use
    std::uint32_t layer = 0;    ///< from 0 at the top
    std::uint32_t triangle = 0; ///< of the top
};

/// Cells between two surfaces.
struct PrismMesh {
    std::vector<Point3> vertices; ///< each once
    std::vector<PrismCell> cells; ///< by triangle, from the top down
    std::vector<PrismGap> gaps;   ///< by triangle
    double volume = 0;            ///< the double nearest to the exact sum of all cells
};

/// Makes prisms between a top and a base, neither of which folds over in the map; their vertical triangles do not
/// count.
/// Errors: bad_option for options out of bounds, and for a surface that folds over; nothing_to_do if no prism stands
/// anywhere; those of validate(); interrupted.
Result<PrismMesh> make_prisms(const Surface& top, const Surface& base,
                              const PrismOptions& options = {}, const Run& run = {});

} // namespace terrane
