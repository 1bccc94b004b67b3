// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Maps of standard deviations that a project names.
#pragma once

#include <optional>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/pipeline/project.hpp>

namespace terrane {

/// Reads the map of each entry of "uncertainty"; none where it has none. Errors: those of read_surfaces; bad_option
/// with the key of a file that holds no surface or several.
Result<std::vector<std::optional<Surface>>> read_uncertainty_maps(const Project& project);

} // namespace terrane
