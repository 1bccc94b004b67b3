// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files that gzip, xz or ZIP have compressed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::detail {

/// Whether contents begin as those of gzip, xz or a ZIP archive do.
bool is_compressed(std::string_view contents);

/// Returns the path without its ending .gz, .xz or .zip, in any case.
std::filesystem::path without_compression(const std::filesystem::path& path);

/// Returns what was compressed: one or several members of gzip, streams of xz, or the only file of a ZIP archive.
/// `source` is the place of errors: bad_syntax where the data are cut off or damaged; unsupported where they grow to
/// more than 64 MiB and 100 times their size, as no text of coordinates does, where an archive has several files,
/// passwords or other methods than Deflate, and for xz where liblzma was not there when Terrane was built.
Result<std::string> decompressed(std::string_view contents, std::string_view source);

} // namespace terrane::detail
