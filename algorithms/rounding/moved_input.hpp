// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How an input is moved where the doubles of its arrangement are not conforming: what round_to_doubles()
// and an arrangement in tiles of space have in common, so that both move it in the same way.
#pragma once

#include <terrane/algorithms/rounding/detail/closed_parts.hpp>
#include <terrane/algorithms/rounding/detail/contact_clusters.hpp>
#include <terrane/algorithms/rounding/detail/moved_attempts.hpp>
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>
#include <terrane/algorithms/rounding/detail/reports.hpp>
#include <terrane/algorithms/rounding/detail/vanished.hpp>

namespace terrane {

using rounding::detail::attempt_moves;
using rounding::detail::Attempted;
using rounding::detail::cluster_directions;
using rounding::detail::cluster_tolerance;
using rounding::detail::ClusterFrame;
using rounding::detail::DecimalFrame;
using rounding::detail::grid_of_digits;
using rounding::detail::InputFrame;
using rounding::detail::KeptPlanes;
using rounding::detail::may_change_joints;
using rounding::detail::MovableInput;
using rounding::detail::move_bound;
using rounding::detail::nothing_left;
using rounding::detail::ParentsInContact;
using rounding::detail::SnapCells;
using rounding::detail::SnapGrid;
using rounding::detail::stated_deviations;

} // namespace terrane
