// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A folder of results appears with all of its files, or not at all.
#pragma once

#include <filesystem>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// Fails where no folder can be made: its parent is missing or write-protected, or `path` exists
/// and is not an empty folder that can be replaced, as a link, a mount point, a protected folder
/// and the folder in which the program runs cannot. Makes and removes a folder next to it, as only
/// that shows that one can be made. Errors: cannot_open.
Status check_new_folder(const std::filesystem::path& path);

/// A folder that gets its name when it is complete. Write files into temporary(), by write_file(), then
/// call publish().
class NewFolder {
public:
    /// Errors: cannot_open, as check_new_folder.
    static Result<NewFolder> create(const std::filesystem::path& path);
    NewFolder(NewFolder&& other) noexcept;
    NewFolder& operator=(NewFolder&& other) noexcept;
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    ~NewFolder(); ///< removes the temporary folder unless it was published

    /// The folder to write to; it is in the parent of the final folder, so that it can be renamed.
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

    /// Flushes all files to the disk at once, then renames the temporary folder to its final name.
    /// Errors: write_failed; the destructor then removes the folder.
    Status publish();

private:
    NewFolder(std::filesystem::path target, std::filesystem::path temporary);

    std::filesystem::path target_, temporary_; ///< temporary_ is empty when published
};

} // namespace terrane
