// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures the gaps between free borders and other surfaces.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>

namespace terrane::sealing::detail {

/// The free part of a border edge and its distance from other surfaces.
struct Gap {
    BorderEdge edge{};
    double length = 0, largest = 0;
    Point3 place{};       ///< where the distance is largest
    std::uint32_t to = 0; ///< the surface nearest to that place
};

/// Computes distances to surfaces, up to a bound.
class GapDistances {
public:
    /// A point of another surface.
    struct Near {
        Point3 place{};
        std::uint32_t surface = 0;
    };

    /// The arrangement must outlive the object.
    GapDistances(const Arrangement& arrangement, double bound);
    GapDistances(const GapDistances&) = delete; // the trees refer to places_
    GapDistances& operator=(const GapDistances&) = delete;
    GapDistances(GapDistances&&) = delete;
    GapDistances& operator=(GapDistances&&) = delete;
    ~GapDistances() = default;

    /// Measures the free parts of the edge that are within the bound of a surface other than the
    /// edge's own everywhere. Returns nothing if there are none.
    [[nodiscard]] std::optional<Gap> gap_at(const BorderEdge& edge) const;
    /// Finds the point nearest to p on a surface that does not contain the edge's triangle; that of
    /// the first surface among equals.
    [[nodiscard]] std::optional<Near> nearest(const Point3& p, const BorderEdge& edge) const;

private:
    void add_part(Gap& gap, const Point3& p, const Point3& q) const;

    const double bound_;
    std::vector<Point3> places_;
    std::vector<TriangleTree> trees_; ///< per surface
};

} // namespace terrane::sealing::detail
