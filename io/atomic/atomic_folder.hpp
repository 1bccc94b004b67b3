// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Folders in one piece: all of their files, or nothing.
#pragma once

#include <filesystem>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// An error where no folder can be made: its parent is missing or protected, or `path` exists and
/// is no empty folder.
Status check_new_folder(const std::filesystem::path& path);

/// A folder that gets its name when it is complete. Fill temporary(), then publish().
class NewFolder {
public:
    /// Errors: cannot_open, as check_new_folder.
    static Result<NewFolder> create(const std::filesystem::path& path);
    NewFolder(NewFolder&& other) noexcept;
    NewFolder& operator=(NewFolder&& other) noexcept;
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    ~NewFolder(); ///< removes what was not published

    /// Beside the final place, so that it can be renamed.
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

    /// Errors: write_failed; the folder is then removed.
    Status publish();

private:
    NewFolder(std::filesystem::path target, std::filesystem::path temporary);

    std::filesystem::path target_, temporary_; ///< temporary_ is empty when published
};

} // namespace terrane
