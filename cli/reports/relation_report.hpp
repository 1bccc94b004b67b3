// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tables of how surfaces end at each other and which blocks face each other, as CSV.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane::cli {

/// Returns surface, kind, other, length, least_gap, largest_gap, x, y, z; the gaps are empty but
/// for surfaces that end near others.
std::string csv_of(std::span<const SurfaceRelation> relations,
                   const std::vector<std::string>& labels);

/// Returns surface, block, name, other_block, other_name, area.
std::string csv_of(std::span<const Juxtaposition> juxtapositions,
                   const std::vector<std::string>& labels, const Structure& structure);

} // namespace terrane::cli
