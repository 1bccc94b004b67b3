// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Moves points by the throw of a fault.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/uncertainty/detail/fault_plane.hpp>

namespace terrane::uncertainty::detail {

/// The share of a throw by which each vertex of a surface moves.
struct SlipShares {
    SurfaceId surface{};
    std::vector<double> shares{}; ///< per vertex, in [0, 1]
};

/// Finds the share of each vertex of a horizon: 1 on the side of the fault to which its normal points,
/// abreast of it, and less in proportion to the distance up to `reach`; 0 on the other side. A vertex on the
/// fault is on the side of its neighbours.
SlipShares slip_shares(std::span<const Surface> all, std::span<const std::uint32_t> fault,
                       const FaultPlane& plane, std::optional<double> reach, SurfaceId horizon);

} // namespace terrane::uncertainty::detail
