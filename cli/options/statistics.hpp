// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The document that --stats writes. docs/reference/statistics.md lists its keys.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/io/text/json.hpp>

namespace terrane::cli {

using Json = detail::Json;

/// Starts the document with the version, the input's counts, and the constants of reading. add_statistics adds the keys of the stages that were run.
Json statistics_of(const Inputs& inputs);
/// Adds the keys search, arrangement and predicates.
void add_statistics(Json& json, const ArrangeStatistics& statistics);
/// Does the same, and counts triangles that were set aside.
void add_statistics(Json& json, const Arrangement& arrangement);
/// Adds the keys output and rounding, with the constants of rounding.
void add_statistics(Json& json, const RoundedMesh& rounded);

/// Adds the constants of a stage under the key constants.
void add_constants(Json& json, const char* stage, std::span<const NamedConstant> constants);

/// Returns the seconds of the stages that have ended, and of the whole run so far.
Json seconds_json(const Session& session);
/// Adds these seconds and the peak memory, and writes the document; does nothing for an empty path.
void write_statistics(Json json, const std::string& path, const Session& session);

/// Returns the peak resident memory of the process in MiB.
double peak_memory();

/// Returns indented text; bytes that are not UTF-8 become U+FFFD, and control characters, and those that
/// change the direction of text, are escaped.
std::string text_of(const Json& json);

} // namespace terrane::cli
