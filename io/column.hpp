// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A stratigraphic column in a file of its own: a JSON object with the key column, which means what
// it does in a project file.
#pragma once

#include <filesystem>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/structure/column.hpp>

namespace terrane {

/// Parses a column; `source` names the file in messages. Errors: bad_syntax, bad_option with the
/// key, as parse_project() has them; those of check_column().
Result<StratigraphicColumn> parse_column(std::string_view text, std::string_view source);

/// Reads and parses a column. Errors: cannot_open, and those of parse_column.
Result<StratigraphicColumn> read_column(const std::filesystem::path& path);

} // namespace terrane
