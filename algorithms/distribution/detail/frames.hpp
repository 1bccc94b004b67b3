// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The way of doubles out of a frame in which the blocks have arranged the input. Where a place in the frame
// goes depends on the input points that became it, or that are next to it, and these are in other blocks.
#pragma once

#include <terrane/algorithms/distribution/detail/steps.hpp>
#include <terrane/algorithms/rounding/moved_input.hpp>

namespace terrane::distribution::detail {

/// Returns the work beside the steps that takes the doubles of all blocks back from a frame. Blocks ask
/// where the places of their points go, and those to which a hash points tell it.
StepsBeside steps_back(const DecimalFrame& frame);
StepsBeside steps_back(const ClusterFrame& frame);

/// A block sends the places of its input vertices in a frame. Channel 0: HomePlace, to where a hash of the
/// place points.
void send_places(const Block& b, const ClusterFrame& frame, Outbox& out);
/// Returns the largest error of the places that came; see InputFrame::largest_error().
double largest_error_of_places(const ClusterFrame& frame, Inbox& in);

} // namespace terrane::distribution::detail
