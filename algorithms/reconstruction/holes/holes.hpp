// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Where a surface ends: its borders as closed loops, told apart into what surrounds it, holes in
// it, and gaps that a fault has torn.
//
// Which edges are borders, and how they hang together, depends on indices and equal points alone.
// What a loop is called rests on measures in floating point, by the rules stated with LoopKind.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

enum class LoopKind : std::uint8_t {
    outer, ///< in each part connected over edges, the loop with the longest diagonal of its box,
           ///< if that is at least half of the part's own (else it is a closed body with
           ///< holes); and every loop that runs along edges of more than two triangles
    hole,  ///< all others
    fault_gap, ///< a hole whose sides face each other with a throw: see GapRule
};

/// A hole is a fault gap where the surface, carried on from both sides to the middle with the slope
/// that it has there, does not meet itself: by a throw that is `slope` times the width of the gap
/// or more, three times the roughness of the border or more, and with the same side up along
/// four fifths of it.
struct GapRule {
    double slope = 0.25; ///< no unit; > 0
};

/// A closed loop of border edges. Lengths in the unit of the surface.
struct BorderLoop {
    LoopKind kind = LoopKind::hole;
    std::vector<std::uint32_t> vertices{}; ///< of the surface, in order, each once, >= 3: the
                                           ///< surface on the left as its front is seen. Of equal
                                           ///< points the one with the lowest index
    std::uint32_t part = 0;   ///< the connected part of the surface, by its lowest triangle
    std::uint32_t shared = 0; ///< edges with more than two triangles among those of the loop
    double length = 0;        ///< of its edges
    double area = 0;          ///< of its projection onto the plane that makes it largest
    Point3 centre{};          ///< of its edges, weighted by their lengths
    double fault_throw = 0;   ///< holes: median distance, along the normal of the surface
                              ///< there, by which its facing sides miss each other
    double width = 0;         ///< holes: median distance between facing sides
};

/// All borders of a surface: outer ones by falling length, then holes and gaps by falling area.
/// Equal points count as one vertex; triangles without area, and repeated ones, do not count.
/// Where a border meets itself in a vertex it is split there. Edges of more than two triangles cut
/// the surface as borders do; loops with no other edges are left out.
/// Cost: linear, and for each hole 256 passes over its edges at most.
/// Errors: bad_number, bad_index, interrupted.
Result<std::vector<BorderLoop>> find_border_loops(const Surface& surface, const Run& run = {},
                                                  const GapRule& rule = {});

} // namespace terrane
