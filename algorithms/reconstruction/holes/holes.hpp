// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the borders of a surface as closed loops and classifies them: outer borders, holes, and
// gaps torn by faults.
//
// Which edges are border edges and how they are connected depends on indices and equal points
// alone. The classification uses measures in floating point, by the rules stated with LoopKind.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// What a loop of border edges is to its surface.
enum class LoopKind : std::uint8_t {
    outer, ///< in each part connected across edges, the loop whose bounding box has the longest
           ///< diagonal, if that is at least half of the diagonal of the part (otherwise the part
           ///< is a closed body with holes); and every loop with an edge of more than two triangles
    hole,  ///< all others
    fault_gap, ///< a hole whose opposite sides have a throw, see GapRule
};

/// Decides whether a hole is a fault gap. The surface is extrapolated from both sides to the middle
/// of the hole with the slope it has at the border. The hole is a fault gap if the two
/// extrapolations differ by a throw of at least `slope` times the width of the gap and at least
/// three times the roughness of the border, with the same side up along four fifths of the gap.
struct GapRule {
    double slope = 0.25; ///< throw / width; dimensionless, > 0
};

/// A closed loop of border edges. Lengths are in the unit of the surface.
struct BorderLoop {
    LoopKind kind = LoopKind::hole;        ///< outline, hole or fault gap
    std::vector<std::uint32_t> vertices{}; ///< of the surface, in order, each once, >= 3; the
                                           ///< surface is on the left, seen from its front. Of
                                           ///< equal points, the one with the lowest index
    std::uint32_t part = 0;                ///< connected part of the surface: its lowest triangle
    std::uint32_t shared = 0;              ///< edges of the loop with more than two triangles
    double length = 0;                     ///< total length of its edges
    double area = 0;                       ///< of its largest projection to a plane
    Point3 centre{};                       ///< mean of its edges, weighted by length
    double fault_throw = 0; ///< holes: median distance between the extrapolated sides, along the
                            ///< mean normal of the border
    double width = 0;       ///< holes: median distance between opposite sides
};

/// Finds all borders of a surface: outer ones by decreasing length, then holes and gaps by
/// decreasing area. Equal points count as one vertex; degenerate and repeated triangles are
/// ignored. A border that visits a vertex twice is split there. Edges of more than two triangles
/// cut the surface like borders; loops of such edges only are omitted.
/// Cost: linear, plus at most 256 passes over the edges of each hole.
/// Errors: bad_number, bad_index, interrupted.
Result<std::vector<BorderLoop>> find_border_loops(const Surface& surface, const Run& run = {},
                                                  const GapRule& rule = {});

} // namespace terrane
