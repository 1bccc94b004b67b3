// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Borders of input surfaces, and strips of new triangles beyond them. Shared by sealing and the
// extension to a volume's boundary; private to them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// An edge of an input surface with one triangle of it. Vertices are canonical input vertices, as
/// in InputTriangles::corners.
struct BorderEdge {
    std::uint32_t surface = 0;
    std::uint32_t triangle = 0;       ///< input triangle
    std::uint32_t from = 0, to = 0;   ///< wound like the triangle
    std::vector<std::uint32_t> own{}; ///< surfaces of the triangles at its open parts, ascending
    std::vector<Edge> open{};         ///< its parts in the arrangement with one triangle: vertices
};

/// All border edges that have open parts; by surface, then triangle. Exact. `ignored`: input
/// triangles that are taken for not there; may be shorter than their number.
std::vector<BorderEdge> open_border_edges(const Arrangement& arrangement,
                                          std::vector<bool> ignored = {});

/// What a triangle of a strip is: it lies beyond a border edge, or fans out at the end of a strip.
struct ExtensionTriangle {
    std::uint32_t surface = 0;
    std::uint32_t piece = 0; ///< edges of the border from 0, then fans: the same for both triangles
                             ///< of a quadrilateral
    bool is_fan = false;
    std::array<Point3, 3> corners{};
    std::array<bool, 3> is_base{}; ///< the corner is one of the border's
    unsigned side = 3; ///< the edge from this corner on is the side of a quadrilateral, which a fan
                       ///< shares with it
};

/// How far a strip goes beyond one border edge.
struct StripEdge {
    BorderEdge edge{};
    double reach = 0;                               ///< > 0, unit of the input
    std::optional<std::array<Point3, 2>> targets{}; ///< points to go to beyond its ends, and past
                                                    ///< them by half; none: along the tangent plane
    std::uint32_t piece = 0;                        ///< unique
};

/// Quadrilaterals beyond the edges, joined at their common vertices, with mitred corners; at the
/// ends of a chain of edges fans that widen it. Wound like their surface.
std::vector<ExtensionTriangle> make_strips(const Arrangement& arrangement,
                                           std::span<const StripEdge> edges);

/// Appends the triangles to their surfaces, in order.
void append_strips(std::vector<Surface>& surfaces, std::span<const ExtensionTriangle> strips);

/// Whether both ends of an edge of the arrangement lie on the edge between two input vertices of a
/// triangle that contains the edge. Exact. The caller holds an UpwardRounding.
bool lies_on(const Arrangement& arrangement, const Edge& edge, std::uint32_t input_triangle,
             std::uint32_t from, std::uint32_t to);

} // namespace terrane
