// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The key "uncertainty" of a project.
#pragma once

#include <filesystem>
#include <vector>

#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/io/detail/json_reader.hpp>

namespace terrane::detail {

/// Reads the entries; maps are relative to the folder `base`. Errors stay in the reader.
std::vector<ProjectUncertainty> uncertainty_of(JsonReader& in, const Json& json,
                                               const std::filesystem::path& base);

} // namespace terrane::detail
