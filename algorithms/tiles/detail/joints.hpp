// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds meshes that round_to_doubles() takes only if no other attempt is conforming: two input triangles
// with a common side are ill-joined, or surfaces that met are parted. To be sure takes the whole model, so
// tiles leave it to one process where a mesh may be such.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>

namespace terrane::tiles::detail {

/// A corner of an input triangle.
struct GivenCorner {
    std::uint32_t id = 0, unused = 0; ///< first vertex at its place
    Point3 at{};

    friend auto operator<=>(const GivenCorner& p, const GivenCorner& q) { return p.id <=> q.id; }
    friend bool operator==(const GivenCorner& p, const GivenCorner& q) { return p.id == q.id; }
};
using GivenCorners = std::map<std::uint32_t, std::array<GivenCorner, 3>>; ///< by input triangle

/// Lets the first tile learn the corners of input triangles, as they were before any was moved, that are not in
/// `corners` yet. Both arguments count in the process of the first tile.
Status find_corners(Supersteps& tiles, const std::vector<std::uint32_t>& triangles,
                    GivenCorners& corners);

/// Pairs of surfaces, and the box of the vertices that both have.
using Meetings = std::map<std::pair<std::uint32_t, std::uint32_t>, Box>;

/// Returns those of all tiles, in all processes.
Result<Meetings> find_meetings(Supersteps& tiles);

/// Returns false if are_parted() is, for a mesh whose surfaces meet as in `after` and have moved by at most `deviation`
/// or somewhat more.
bool may_be_parted(const Meetings& before, const Meetings& after, double deviation);

} // namespace terrane::tiles::detail
