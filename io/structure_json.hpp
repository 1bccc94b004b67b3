// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A model's corners, lines, surfaces and blocks as JSON. An object with
//
//   format      "terrane-model 1"
//   surfaces    the input surfaces: name, role (unknown, horizon, fault, boundary), area,
//               dangling_area (of what has the same volume on both sides)
//   blocks      [0] is the outside, then the blocks by number: name, volume (of the exact surfaces,
//               to the nearest double; null for a block that only rounding made), volume_written
//               (of the doubles in the files, to the nearest), area, above, below, beside
//               (surfaces), interfaces (around it), inner_interfaces (dangling in it), neighbours
//               (blocks), file
//   interfaces  what is between the same two blocks and in the same surfaces: volumes (two; equal:
//               it dangles), surfaces, area, patches, file
//   patches     connected parts of interfaces: interface, area, triangles (of the result, ranges
//               [first, last] of numbers), lines
//   lines       kind ("free border", "boundary line", "cutoff line", "branch line", "intersection
//               curve"), vertices (of the result; first = last: closed), corners (two, or null),
//               patches, surfaces, length
//   corners     vertex, position, lines
//   free_borders  line, surfaces, length, closed, gaps: by the nearest other surface along the
//   border
//               and the order of magnitude of the distance: surface, length of the border there,
//               least and largest distance, place of the latter
//   leaks       the same by pairs: from (ends), to (nearest), borders (number of parts), length,
//               least, largest, place; the smallest distances first
//   seal        only where gaps were closed on request: distance (as asked for), changes: kind
//               (extended, trimmed), surface, length of the border there, largest distance, place,
//               triangles (added or removed)
//
// A block that is too thin for doubles has a volume, but nothing else: volume_written is 0.
// All numbers of things are positions in these arrays, from 0. Lengths, areas and volumes are in
// the unit of the input. Doubles read back as the same doubles; what is no number (an infinity) is
// null.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/structure/free_borders.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane {

/// What stands beside the structure in the file.
struct StructureExtras {
    std::vector<double> exact_volumes{};        ///< per volume; NaN where there is none
    std::vector<std::string> block_files{};     ///< per volume; empty: none
    std::vector<std::string> interface_files{}; ///< per interface; empty: none
    std::span<const FreeBorder> free_borders{};
    double seal_distance = 0; ///< 0: not asked for
    std::span<const SealChange> seal_changes{};
};

/// Precondition: lists of extras are empty or have the lengths stated.
std::string to_json(const Mesh& mesh, const Structure& structure, const StructureExtras& extras);

} // namespace terrane
