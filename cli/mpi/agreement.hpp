// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the settings that all processes must share. All of them call these functions, in the
// same order.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::cli {

/// Returns the error of the first process that has one, in all processes.
Status agreed(const Status& own);

/// Compares the version and the words of the command line before any of them is used. Errors: bad_option.
Status check_same_command(std::span<const char* const> words);

/// Compares the files that are read: their sizes, and hashes of their first and last 64 KiB. A file
/// that no process can read is left to the reader. Errors: cannot_open, with the file.
Status check_same_files(std::span<const std::string> files);

} // namespace terrane::cli
