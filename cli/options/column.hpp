// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The option --column, and what else names the blocks.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/cli/options/files.hpp>

namespace terrane::cli {

void add_column(CLI::App& command, std::string& file);

/// Reads the column, if a file is given, and takes the blocks that the inputs state. Errors: those of
/// read_column; bad_option for a base that is no surface of the inputs.
Result<BlockNaming> naming_of(const std::string& column_file, const Inputs& inputs);

} // namespace terrane::cli
