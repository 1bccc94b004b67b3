// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files and folders of one run appear together: all are complete under temporary names before the
// first gets its own.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
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
    ~FileSet(); ///< removes the files that were not published
    FileSet(const FileSet&) = delete;
    FileSet& operator=(const FileSet&) = delete;

    /// Returns the one that lives in this thread, or null.
    static FileSet* current();

    /// Adds a complete file or folder, which is removed unless it is published. Errors, with the
    /// target, which is not added: bad_option where it would replace another result or a kept file,
    /// or one of them would be in the other.
    Status add(std::filesystem::path temporary, std::filesystem::path target);
    /// Keeps a file from being replaced by files that are added later.
    void keep(const std::filesystem::path& file);
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
        std::filesystem::path place; ///< the target without links
    };
    std::vector<Pending> pending_;
    std::vector<std::filesystem::path> kept_; ///< without links
    std::vector<std::function<void()>> tells_;
};

/// Makes a temporary file or folder by `make`, and notes it, so that remove_temporaries() finds it,
/// whichever thread calls that and when. `final_path` is its name when it is complete. Returns what
/// `make` returns: whether there is one now.
bool make_temporary(const std::filesystem::path& path, const std::filesystem::path& final_path,
                    const std::function<bool()>& make);
/// Forgets it: it has its name, or is removed.
void forget_temporary(const std::filesystem::path& path);
/// Tells whether two paths name the same file or folder, by any of their names, whether it exists or
/// not. Pipes and devices are never the same.
bool are_same(const std::filesystem::path& a, const std::filesystem::path& b);
/// Tells whether they are the same or one of them names a folder in which the other one is.
bool overlap(const std::filesystem::path& a, const std::filesystem::path& b);
/// Tells whether a path is in such a folder, where files need no temporary names.
bool is_in_temporary(const std::filesystem::path& path);
/// Returns the name that a temporary file or folder, or a file in one, will have, for messages; other
/// paths as they are.
std::filesystem::path final_path_of(const std::filesystem::path& path);
/// Removes a temporary file or folder and forgets it. Never throws: where not even the system gets
/// the memory to list a folder, that is left.
void discard_temporary(const std::filesystem::path& path) noexcept;
/// Removes all temporary files and folders of this process, which is about to end. Any thread may
/// call it; others may still be writing. No other is made while the returned lock lives.
[[nodiscard]] std::unique_lock<std::mutex> remove_temporaries();

} // namespace terrane
