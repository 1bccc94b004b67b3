// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/files.hpp>

namespace terrane {

/// Refuses what a caller says of files of these formats if it is about none of them: `depth` of files that are neither
/// grids nor points, `max_edge` of files that are not points. `option_names` are those two options, as the caller knows them.
/// Errors: bad_option.
Status check_reading(const std::vector<std::optional<Format>>& files, const ReadOptions& options,
                     const std::array<const char*, 2>& option_names);

} // namespace terrane
