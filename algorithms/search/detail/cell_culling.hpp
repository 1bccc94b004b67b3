// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The reduction step of the mixed search (paper 2.3), for any number of groups: which boxes can
// meet one of another group at all.
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

/// All boxes.
Selection select_all(const BoxSource& boxes);

/// At least all boxes that overlap one of another group (no_group: any other one). First the boxes
/// outside all other groups' common box go, then those in whose cells there is only their own
/// group. Unlike in the paper a box is entered in each cell that it overlaps, so two boxes that
/// overlap share a cell, and no cell need be searched around it. Cost: linear; where a few boxes
/// cover very many cells the second step is left out.
Selection select_meeting(const BoxSource& boxes, std::span<const std::uint32_t> groups,
                         const Run& run);

/// At least all boxes that overlap an active one, and the active ones themselves.
/// active: indices, ascending.
Selection select_near(const BoxSource& boxes, std::span<const std::uint32_t> active,
                      const Run& run);

} // namespace terrane::search
