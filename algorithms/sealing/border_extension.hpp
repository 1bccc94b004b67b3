// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds borders of input surfaces and builds strips of new triangles beyond them. Internal; shared
// by sealing and the extension to the boundary of a volume.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/numbers.hpp>

namespace terrane {

/// The constants of strips that sealing and the extension to a boundary share.
struct StripConstants {
    /// Least cosine between the directions at a mitred corner and at its edges: corners are wider
    /// than strips by at most the inverse. Smaller: longer spikes at sharp corners.
    double least_mitre_cosine = 0.4;
    /// How far strips go beyond their targets, as a share of the way there, so that they certainly
    /// cross the surface. Larger: more triangles are cut off again.
    double beyond_targets = 0.5;
};
inline constexpr StripConstants strip_constants;

/// An edge of an input surface with one triangle. Vertices are canonical input vertices, as in
/// InputTriangles::corners.
struct BorderEdge {
    SurfaceId surface{};
    InputTriangleId triangle{};       ///< input triangle
    std::uint32_t from = 0, to = 0;   ///< oriented like the triangle
    std::vector<std::uint32_t> own{}; ///< surfaces of the triangles at its open parts, ascending
    std::vector<Edge> open{};         ///< its parts with one triangle in the arrangement: pairs of
                                      ///< vertices
};

/// Finds all border edges that have open parts, exactly; by surface, then triangle. Input triangles
/// marked in `ignored` are treated as absent; the list may be shorter than their number.
std::vector<BorderEdge> open_border_edges(const Arrangement& arrangement,
                                          std::vector<bool> ignored = {});

/// A triangle of a strip: part of the quadrilateral beyond a border edge, or a fan at the end of a
/// strip.
struct ExtensionTriangle {
    SurfaceId surface{};
    std::uint32_t piece = 0; ///< quadrilaterals by border edge from 0, then fans; the same for both
                             ///< triangles of a quadrilateral
    bool is_fan = false;
    std::array<Point3, 3> corners{};
    std::array<bool, 3> is_base{}; ///< the corner lies on the border
    unsigned side = 3; ///< the edge from this corner on is the side of a quadrilateral, which a fan
                       ///< shares
    std::array<bool, 3> joins{}; ///< of a bridge: the edge from the corner on lies on a border; the
                                 ///< other edges are sides

    /// Tells whether the triangle is part of a bridge, which has all corners on borders.
    [[nodiscard]] bool is_bridge() const { return joins[0] || joins[1] || joins[2]; }
    /// Tells whether the edge from a corner on may stay free.
    [[nodiscard]] bool is_side(unsigned k) const {
        return is_bridge() ? !joins[k] : !is_fan && side == k;
    }
};

/// A border edge to extend, and how far.
struct StripEdge {
    BorderEdge edge{};
    double reach = 0;                               ///< width of the strip, > 0, unit of the input
    std::optional<std::array<Point3, 2>> targets{}; ///< points to aim at from its ends; the strip
                                                    ///< goes beyond them by half. None: it follows
                                                    ///< the tangent plane
    std::uint32_t piece = 0;                        ///< unique
};

/// Returns the unit vector in the plane of a border edge's triangle, perpendicular to the edge and
/// away from the triangle.
Point3 outward_of(const Arrangement& arrangement, const BorderEdge& edge);

/// Builds quadrilaterals beyond the edges, joined at their common vertices, with mitred corners,
/// and widening fans at the ends of chains of edges. Triangles are oriented like their surface.
std::vector<ExtensionTriangle> make_strips(const Arrangement& arrangement,
                                           std::span<const StripEdge> edges);

/// Appends the triangles to their surfaces, in order.
void append_strips(std::vector<Surface>& surfaces, std::span<const ExtensionTriangle> strips);

/// Tells exactly whether both ends of an edge of the arrangement lie on the edge between two input
/// vertices of a triangle that contains the edge.
bool lies_on(UpwardWitness upward, const Arrangement& arrangement, const Edge& edge,
             InputTriangleId input_triangle, std::uint32_t from, std::uint32_t to);

} // namespace terrane
