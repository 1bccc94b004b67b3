// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The way of doubles out of a frame in which the tiles have arranged the input. Where a place in the frame
// goes depends on the input points that became it, or that are next to it, and these are in other tiles.
#pragma once

#include <terrane/algorithms/rounding/moved_input.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles::detail {

/// Returns the work next to the steps that takes the doubles of all tiles back from a frame. Tiles
/// ask where the places of their points go, and those to which a hash points tell it.
StepsBeside steps_back(const DecimalFrame& frame);
StepsBeside steps_back(const ClusterFrame& frame);

/// A tile sends the places of its input vertices in a frame. Channel 0: HomePlace, to where a hash of the
/// place points.
void send_places(const Tile& b, const ClusterFrame& frame, Outbox& out);
/// Returns the largest error of the places that came; see InputFrame::largest_error().
double largest_error_of_places(const ClusterFrame& frame, Inbox& in);

} // namespace terrane::tiles::detail
