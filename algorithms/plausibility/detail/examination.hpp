// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The surfaces under examination, with the data that all checks need. Each check adds at most one
// warning for each group of surfaces.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/plausibility/detail/extents.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>

namespace terrane::plausibility::detail {

struct Examination {
    Examination(std::span<const Surface> examined, const PlausibilityContext& use);

    std::span<const Surface> surfaces;
    const PlausibilityContext& context;
    std::vector<std::string> labels;
    std::vector<Extent> extents;
    std::vector<std::uint32_t> used; ///< surfaces with triangles
    std::vector<PlausibilityWarning> warnings{};

    /// Adds a warning about the surfaces with these indices.
    void warn(Doubt doubt, const std::vector<std::uint32_t>& about, std::string seen,
              std::string why, std::string answer);

    /// Returns names of surfaces in a sentence: "top", "top and base", "top, base and 3 more".
    [[nodiscard]] std::string names(const std::vector<std::uint32_t>& about) const;
};

// heights.cpp
void check_heights(Examination& examination);
void check_unstated_depths(Examination& examination);
// places.cpp
void check_distances(Examination& examination);
void check_volume(Examination& examination);
void check_top_and_base(Examination& examination);
// frames.cpp
void check_units(Examination& examination);
void check_systems(Examination& examination);
/// Tells whether the horizontal coordinates look like degrees.
bool in_degrees(const Extent& extent);
// copies.cpp
void check_float32(Examination& examination);
void check_values(Examination& examination);
void check_faces(Examination& examination);
void check_duplicates(Examination& examination);

} // namespace terrane::plausibility::detail
