// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The tables of a page: {"title", "columns": [{"title", "measure"}], "rows": [[...]]}.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/io/page/json.hpp>
#include <terrane/io/page/scene.hpp>

namespace terrane::page {

/// Returns the columns of a table; a measure says what unit its numbers have: "text", "count",
/// "length", "area", "volume", "number".
Json columns(std::initializer_list<std::pair<const char*, const char*>> titles);

/// Returns the path, size and SHA-256 of a file. Errors: cannot_open.
Result<Json> file_row(const std::string& path);

/// Returns the blocks from number 1 on: number, name, volume, area, above, below, beside (indices
/// of surfaces), neighbours.
Json blocks_json(const Model& model, const std::vector<std::string>& labels);
/// Returns the table of blocks and that of neighbours with their areas.
std::vector<Json> block_tables(const Model& model, const std::vector<std::string>& labels);

Json surface_table(const Json& surfaces);
/// The options that were given, and their values.
Json option_table(const std::vector<std::pair<std::string, std::string>>& options);
/// Holes with their fillings.
Json fill_table(const FillWork& work);
/// Lists all single values of a document by their paths.
Json value_table(const char* title, const Json& document);

/// Makes the fillings of each surface a part of their own behind its part.
void split_filled(Scene& scene, const FillWork& work);

} // namespace terrane::page
