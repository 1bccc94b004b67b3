// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files in one piece: read whole, written whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// The bytes of a file; "-" is standard input. Errors: cannot_open.
Result<std::string> read_file(const std::filesystem::path& path);

/// Puts `contents` where `path` is, or leaves what is there as it is: writes to a temporary name in
/// the same folder, down to the disk, then renames. A link is followed; a file that is there keeps
/// its permissions. "-" (standard output) and what is no regular file (a pipe, a device) are
/// written directly.
/// Errors: cannot_open, write_failed (disk full, ...); no temporary file stays behind.
Status write_file(const std::filesystem::path& path, std::string_view contents);

} // namespace terrane
