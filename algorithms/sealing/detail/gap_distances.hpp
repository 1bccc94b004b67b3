// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures the gaps between free borders and other surfaces.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/surface_tree.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>
#include <terrane/algorithms/sealing/detail/seal_distances.hpp>

namespace terrane::sealing::detail {

/// The free part of a border edge and its distance from other surfaces.
struct Gap {
    BorderEdge edge{};
    double length = 0, largest = 0;
    Point3 place{};       ///< where the distance is largest
    std::uint32_t to = 0; ///< the surface nearest to that place
};

/// Computes distances to surfaces, up to those at which gaps are closed.
class GapDistances {
public:
    /// A point of another surface.
    struct Near {
        Point3 place{};
        std::uint32_t surface = 0;
    };

    /// The arrangement must outlive the object. Cost: a tree for each surface.
    GapDistances(const Arrangement& arrangement, SealDistances distances);
    GapDistances(const GapDistances&) = delete; // the trees refer to places_
    GapDistances& operator=(const GapDistances&) = delete;
    GapDistances(GapDistances&&) = delete;
    GapDistances& operator=(GapDistances&&) = delete;
    ~GapDistances() = default;

    /// Measures the free parts of the edge that are within the distance of a surface other than the
    /// edge's own everywhere. Returns nothing if there are none.
    [[nodiscard]] std::optional<Gap> gap_at(const BorderEdge& edge) const;
    /// Measures the free parts of the edge that are everywhere within the distance of another part
    /// of the edge's own surface, which lies ahead: at most 60 degrees from the direction in which
    /// the surface would go on. Returns nothing if there are none.
    [[nodiscard]] std::optional<Gap> own_gap_at(const BorderEdge& edge) const;
    /// Measures the free parts of the edge only the middle of which is within the distance of
    /// another surface that lies ahead. Returns nothing if there are none.
    [[nodiscard]] std::optional<Gap> part_gap_at(const BorderEdge& edge) const;
    /// Finds the point nearest to p on a surface that does not contain the edge's triangle; that of
    /// the first surface among equals. Looks as far as `factor` times the distances.
    [[nodiscard]] std::optional<Near> nearest(const Point3& p, const BorderEdge& edge,
                                              double factor = 1) const;
    /// Tells whether a surface other than the edge's own and `except` lies ahead of p, as in
    /// own_gap_at(), and is nearer than a distance.
    [[nodiscard]] bool is_any_ahead(const Point3& p, const BorderEdge& edge, std::uint32_t except,
                                    double distance) const;
    /// Finds the nearest point of the edge's own surface that lies ahead, as in own_gap_at().
    [[nodiscard]] std::optional<Near> nearest_own(const Point3& p, const BorderEdge& edge) const;

private:
    template <class Nearest>
    [[nodiscard]] std::optional<Gap> measured(const BorderEdge& edge, const Nearest& find) const;
    [[nodiscard]] double bound(std::uint32_t surface, std::uint32_t other, double factor = 1) const;

    const Arrangement& arrangement_;
    const SealDistances distances_;
    const std::vector<Point3> places_;
    const SurfaceTree near_;
    std::vector<TriangleTree> trees_; ///< per surface
};

} // namespace terrane::sealing::detail
