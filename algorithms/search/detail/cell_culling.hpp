// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Implements the reduction step of the mixed search (paper 2.3) for any number of groups: it
// selects the boxes that may meet one of another group.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/search/detail/packed_box.hpp>

namespace terrane::search {

/// Some boxes of a list, packed on one lattice.
struct Selection {
    std::vector<PackedBox> boxes;
    std::vector<std::uint32_t> indices; ///< per box: its index in the list, ascending
};

/// Selects all boxes.
Selection select_all(const BoxSource& boxes);

/// Selects at least all boxes that overlap one of another group (for no_group: any other one).
/// (1) The first step drops the boxes outside the bounding box of all other groups.
/// (2) The second step drops the boxes whose cells contain their own group only. Unlike in the
///     paper, a box is entered in each cell that it overlaps. Two boxes that overlap therefore
///     share a cell, and no neighbouring cells need be searched. The step is omitted if the boxes
///     cover very many cells.
/// Cost: linear.
Selection select_meeting(const BoxSource& boxes, std::span<const std::uint32_t> groups,
                         const Run& run);

/// Selects at least the active boxes and all boxes that overlap one of them. active: ascending
/// indices.
Selection select_near(const BoxSource& boxes, std::span<const std::uint32_t> active,
                      const Run& run);

} // namespace terrane::search
