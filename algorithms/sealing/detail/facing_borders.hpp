// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds free borders that face each other in nearly one plane: of two surfaces that end side by
// side, or of one with a slit or a notch.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>
#include <terrane/algorithms/sealing/detail/gap_distances.hpp>
#include <terrane/algorithms/sealing/detail/seal_distances.hpp>

namespace terrane::sealing::detail {

/// Free border edges and the distances between them.
class FacingBorders {
public:
    /// The border edge that a border edge faces.
    struct Facing {
        std::uint32_t edge = 0; ///< its number in edges()
        double distance = 0;    ///< from the middle of the edge that faces it
        Point3 place{};         ///< that middle
    };

    /// The arrangement and its measured edges must outlive the object.
    FacingBorders(const Arrangement& arrangement, std::vector<BorderEdge> edges,
                  const SealDistances& distances, const GapDistances& gaps);
    FacingBorders(const FacingBorders&) = delete; // the tree refers to places_
    FacingBorders& operator=(const FacingBorders&) = delete;
    FacingBorders(FacingBorders&&) = delete;
    FacingBorders& operator=(FacingBorders&&) = delete;
    ~FacingBorders() = default;

    [[nodiscard]] std::span<const BorderEdge> edges() const { return edges_; }
    /// Returns the unit vector in which the surface would go on beyond an edge.
    [[nodiscard]] const Point3& outward(std::uint32_t edge) const { return outward_[edge]; }
    /// Finds the nearest edge that the middle of an edge faces: it is within the distance for the
    /// two surfaces, the directions in which the surfaces would go on differ from opposite ones by
    /// at most 30 degrees, and neither lies behind the other. No third surface lies nearer
    /// ahead of both ends and the middle, as a fault does at which a horizon ends from two sides. The edge with the least ends among equals.
    [[nodiscard]] std::optional<Facing> facing(std::uint32_t edge) const;
    /// Tells whether the way between two points lies in a gap between borders of two surfaces, or
    /// of one: it is nowhere farther than half of the distance from both borders. That is looked at
    /// in three places.
    [[nodiscard]] bool is_in_gap(const Point3& p, const Point3& q, std::uint32_t surface,
                                 std::uint32_t other) const;
    /// Tells whether a point that is this far from a surface is as near to its free border, to
    /// edges other than `except`.
    [[nodiscard]] bool is_border_nearest(const Point3& p, std::uint32_t surface, double distance,
                                         const BorderEdge& except = {}) const;
    [[nodiscard]] double length_of(std::uint32_t edge) const;
    [[nodiscard]] Point3 middle_of(std::uint32_t edge) const;

private:
    const std::vector<BorderEdge> edges_;
    const SealDistances distances_;
    const GapDistances& gaps_;
    std::vector<Point3> places_; ///< the ends of each edge
    std::vector<Point3> outward_;
    TriangleTree tree_;
};

} // namespace terrane::sealing::detail
