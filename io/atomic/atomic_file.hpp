// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files are read as a whole, and written as a whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// Returns the number of bytes of a regular file, without opening it. Errors: cannot_open, also for what is no regular
/// file, such as a device or a pipe.
Result<std::uint64_t> size_of_file(const std::filesystem::path& path);

/// Returns the bytes of a file; "-" is standard input. Errors: cannot_open.
Result<std::string> read_file(const std::filesystem::path& path);

/// Follows links from a path to the file that they name, whether that exists or not; at most 40, as
/// the system does.
std::filesystem::path followed(std::filesystem::path path);

/// Replaces the file at `path` by one with these contents, or leaves it unchanged on failure: the
/// contents are written to a temporary file in the same folder and flushed to the disk; then the
/// temporary file is renamed. Links are followed; an existing file keeps its permissions. Standard
/// output ("-") and files that are not regular (pipes, devices) are written directly.
/// Errors: cannot_open, write_failed (disk full, ...); no temporary file is left behind.
/// While a FileSet lives in this thread, it renames the file. In the folder of a NewFolder, which is
/// flushed and renamed as a whole, the file is written in place.
Status write_file(const std::filesystem::path& path, std::string_view contents);

/// Does the same, but replaces the file even while a FileSet lives.
Status write_file_at_once(const std::filesystem::path& path, std::string_view contents);

} // namespace terrane
