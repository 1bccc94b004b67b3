// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Keeps surfaces together that share points, while they move. A place is a point where one or more vertices
// are, of one surface or of several. Rules:
// (1) All vertices at a place move alike, so that what coincides still does.
// (2) Where only one surface is, its own motion counts.
// (3) Where several are, the vertical motion is that of the horizons and the motion across is that of the
//     faults, and both are added. Surfaces that go on through the place lead those that end there;
//     several leaders count by their mean.
// (4) A place of horizons on a fault, or on a boundary, slides along it: its vertical motion follows
//     the plane of the fault there, or the line in which two faults meet, unless that is nearly level.
// (5) The part of a motion at shared places that exceeds the surface's own fades into it: along its
//     border evenly from edge to edge, to 0 at the corners of the border, where it turns by 30 degrees or more;
//     then it is harmonic on the graph of its edges. So a fault whose cutoff lines move keeps its
//     shape, and its triangles are stretched evenly.
// A surface that nothing moves keeps its coordinates to the last bit. Cost: one sparse
// factorisation per surface that shares places, once; then linear.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// How a surface moves by itself.
enum class Motion : std::uint8_t {
    vertical, ///< along z: horizons
    across,   ///< in any direction: faults
    none,     ///< only with others: boundaries
};

/// The places of some surfaces.
class SharedPlaces {
public:
    /// `motions`: per surface. Surfaces of one name count as one where they go on into each other.
    SharedPlaces(std::span<const Surface> surfaces, std::vector<Motion> motions);
    ~SharedPlaces();
    SharedPlaces(SharedPlaces&&) noexcept;
    SharedPlaces& operator=(SharedPlaces&&) noexcept;

    /// Returns the motion of each vertex of each surface, from what each surface would do by itself.
    [[nodiscard]] std::vector<std::vector<Point3>>
    reconciled(const std::vector<std::vector<Point3>>& own) const;

    /// Returns the number of places that several surfaces share.
    [[nodiscard]] std::size_t shared_count() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace terrane
