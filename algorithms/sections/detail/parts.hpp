// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divides the triangles of a section into polygons, and its traces into lines.
#pragma once

#include <vector>

#include <terrane/algorithms/sections/detail/cut.hpp>

namespace terrane::sections {

/// A connected part of the section with the same blocks in front and behind.
struct CutRegion {
    std::vector<std::uint32_t> triangles; ///< of the cut, ascending
    std::vector<std::vector<std::uint32_t>>
        rings; ///< vertices of the arrangement: the outer ring, counterclockwise, then holes
};

/// Finds the regions, by their first triangles, without those that are outside on both sides. Each ring begins at its
/// least vertex along the section. The outer ring is the one with both the least and the greatest vertex of the
/// region: a hole that touched the border in both would divide the region.
std::vector<CutRegion> find_regions(const Cut& cut, const SectionSurface& along);

/// Joins traces to lines, by surface; closed lines repeat their first vertex.
std::vector<SectionLine> find_lines(const Cut& cut);

/// Leaves out the vertices of rings and lines that lie straight between two others and at which nothing else
/// begins or ends, exactly.
void straighten(const Cut& cut, std::vector<CutRegion>& regions, std::vector<SectionLine>& lines);

} // namespace terrane::sections
