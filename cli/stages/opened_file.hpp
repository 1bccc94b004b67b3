// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reads files that somebody else may have put into their place.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include <sys/stat.h>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::cli {

/// A file or folder that is open for reading. Opening it neither follows a link at the end of the path
/// nor waits for the writer of a pipe.
class OpenedFile {
public:
    /// Opens a regular file. Errors: cannot_open.
    static Result<OpenedFile> file(const std::filesystem::path& path);
    /// Opens a folder. Errors: cannot_open.
    static Result<OpenedFile> folder(const std::filesystem::path& path);
    OpenedFile(const OpenedFile&) = delete;
    OpenedFile& operator=(const OpenedFile&) = delete;
    OpenedFile(OpenedFile&& other) noexcept;
    OpenedFile& operator=(OpenedFile&&) = delete;
    ~OpenedFile();

    [[nodiscard]] const struct stat& info() const { return info_; }
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(info_.st_size); }
    /// Returns `count` bytes from an offset on; fewer where the file ends, or can't be read.
    [[nodiscard]] std::string bytes(std::size_t offset, std::size_t count) const;

private:
    static Result<OpenedFile> open(const std::filesystem::path& path, mode_t kind,
                                   const char* other);
    explicit OpenedFile(int number) : number_(number) {}

    int number_; ///< < 0: moved from
    struct stat info_ {};
};

} // namespace terrane::cli
