// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The structure of a model (blocks, interfaces, patches, lines and corners) as a JSON object with
// these keys:
//
//   format      "terrane-model 1"
//   surfaces    the input surfaces: name, role (unknown, horizon, fault, boundary), area,
//               dangling_area (area of the parts with the same block on both sides)
//   blocks      [0] is the outside, then the blocks by number: name, unit (of a stratigraphic
//               column, or layer of the file; only where there is one), age (of the base of that
//               unit, where the column has it), volume (of the exact block,
//               rounded to the nearest double; null for a block that only rounding made),
//               volume_written (volume of the rounded mesh, to the nearest double), area, above,
//               below, beside (surfaces), interfaces (around it), inner_interfaces (dangling in
//               it), neighbours (blocks), file
//   interfaces  the triangles between the same two blocks that belong to the same surfaces: volumes
//               (two blocks; equal if it dangles), surfaces, area, patches, file
//   patches     connected parts of interfaces: interface, area, triangles (of the result, ranges
//               [first, last] of numbers), lines
//   lines       kind ("free border", "boundary line", "cutoff line", "branch line", "intersection
//               curve"), vertices (of the result; first = last: closed), corners (two, or null),
//               patches, surfaces, length
//   corners     vertex, position, lines
//   free_borders  line, surfaces, length, closed, gaps; each gap is the part of the border with the
//               same nearest surface and the same order of magnitude of the distance to it:
//               surface, length of the part, least and largest distance, place of the largest
//   leaks       the gaps of all free borders by pairs of surfaces and order of magnitude, the
//               smallest distances first: from (the surface that ends), to (the nearest one),
//               borders (number of parts), length, least, largest, place; separates (whether closing
//               it separates blocks) where that is known
//   seal        only if gaps were closed on request: distance (the one requested), rules (only if
//               there are any): surfaces (one or two) and distance; changes: kind
//               (extended, trimmed), surface, length of the border there, largest distance, place,
//               triangles (added or removed)
//
// A block that vanished in rounding has a volume, but volume_written 0 and no interfaces.
// Elements are referred to by their positions in these arrays, from 0. Lengths, areas and volumes
// are in units of the input. Doubles read back as the same doubles; infinities and NaN are null.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/io/text/json.hpp>

namespace terrane {

/// The contents of the file beyond the structure.
struct StructureExtras {
    std::vector<double> exact_volumes{};          ///< per volume; NaN if it has none
    std::vector<std::string> block_files{};       ///< per volume; empty: none
    std::vector<std::string> interface_files{};   ///< per interface; empty: none
    std::span<const FreeBorder> free_borders{};   ///< all of the structure
    std::span<const LeakVerdict> leak_verdicts{}; ///< per entry of leaks_of(free_borders); empty:
                                                  ///< they were not judged
    std::optional<double> seal_distance{};        ///< none: not requested; 0: by rules alone
    std::span<const SealRule> seal_rules{};       ///< exceptions from the distance
    std::span<const SealChange> seal_changes{};   ///< what sealing did
};

/// Returns the JSON text. Precondition: the lists of extras are empty or have the lengths stated.
std::string to_json(const Mesh& mesh, const Structure& structure, const StructureExtras& extras);

/// Returns what a certificate states of that text, since it does not follow from the mesh and its blocks
/// (block_certificate.hpp): JSON with doubles as strings.
std::string stated_json(const Structure& structure, const StructureExtras& extras);

/// Returns what `warnings` of the statistics is: docs/reference/statistics.md. labels: of the surfaces.
detail::Json json_of(std::span<const PlausibilityWarning> warnings,
                     std::span<const std::string> labels);

} // namespace terrane
