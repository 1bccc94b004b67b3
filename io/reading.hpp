// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/gocad/gocad.hpp>

namespace terrane {

/// Reads a GOCAD model with its parts and regions. Errors: those of read_surfaces.
Result<GocadModel> read_model(const std::filesystem::path& path);

/// Returns what people call the format of a file that was read. Text with columns of numbers is named by its
/// first lines, whatever its extension. `format`: as stated, if it was.
std::string format_in(const std::filesystem::path& path, std::optional<Format> format);

/// Refuses what a caller says of files of these formats if it is about none of them: `depth` of files that are neither
/// grids nor points, `max_edge` of files that are not points, `columns` of files without columns of numbers, or if these are
/// not three. `option_names` are those options, as the caller knows them. Errors: bad_option.
Status check_reading(const std::vector<std::optional<Format>>& files, const ReadOptions& options,
                     const std::array<const char*, 3>& option_names);

} // namespace terrane
