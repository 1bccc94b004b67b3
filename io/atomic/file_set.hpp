// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files and folders of one run appear together: all are complete under temporary names before the
// first gets its own.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// While one lives, files that write_file() makes in this thread, and folders that NewFolder
/// publishes, keep temporary names; read_file() finds them by their own. Devices, pipes and standard
/// output are written at once. At most one lives in a thread.
class FileSet {
public:
    FileSet();
    ~FileSet(); ///< removes what was not published
    FileSet(const FileSet&) = delete;
    FileSet& operator=(const FileSet&) = delete;

    /// Returns the one that lives in this thread, or null.
    static FileSet* current();

    /// Adds a complete file or folder, which is removed unless it is published.
    void add(std::filesystem::path temporary, std::filesystem::path target);
    /// Calls `tell` after publish() has succeeded, in order.
    void then(std::function<void()> tell);
    /// Returns where the contents of a path are now.
    [[nodiscard]] std::filesystem::path where(const std::filesystem::path& path) const;

    /// Gives all their names, in the order in which they were added. Errors: write_failed, with the
    /// names that were given before.
    Status publish();

private:
    struct Pending {
        std::filesystem::path temporary, target;
    };
    std::vector<Pending> pending_;
    std::vector<std::function<void()>> tells_;
};

/// Notes a temporary file or folder of this process, so that remove_temporaries() finds it.
void note_temporary(const std::filesystem::path& path);
/// Forgets it: it has its name, or is removed.
void forget_temporary(const std::filesystem::path& path);
/// Tells whether a path is in such a folder, where files need no temporary names.
bool is_in_temporary(const std::filesystem::path& path);
/// Removes all temporary files and folders of this process, which is about to end. Any thread may
/// call it; others may still be writing.
void remove_temporaries();

} // namespace terrane
