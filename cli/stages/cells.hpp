// SPDX-License-Identifier: LGPL-3.0-or-later
//
// In which block each cell of a given corner-point grid lies.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/io/grids/corner_point.hpp>

namespace terrane::cli {

struct CellOptions {
    std::string grid;  ///< file that is read; here and below, empty: not given
    std::string cells; ///< file that is written
};

/// Adds --grid and --cells.
void add_cells(CLI::App& command, CellOptions& options);

/// Checks the options and reads the grid, before any work is done; none if none is given.
std::optional<CornerPointGrid> read_grid(const CellOptions& options);

/// Finds the block of each cell, writes the file, and returns its summary. Errors: bad_option if
/// the grid has another unit than the inputs; those of locate_points and of writing.
std::string write_cells(const CellOptions& options, const CornerPointGrid& grid, const Model& model,
                        const Inputs& inputs, Session& session);

} // namespace terrane::cli
