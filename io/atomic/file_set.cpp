// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/atomic/file_set.hpp>

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

thread_local FileSet* current_set = nullptr;

/// The temporary files and folders of this process.
struct Temporaries {
    std::mutex mutex;
    std::map<fs::path, fs::path> finals; ///< by their paths, their names when they are complete
};

Temporaries& temporaries() {
    static auto& all = *new Temporaries; // never destroyed, as threads may end after main
    return all;
}

fs::path normal(const fs::path& path) {
    std::error_code failed;
    auto absolute = fs::absolute(path, failed).lexically_normal();
    return absolute.has_filename() ? absolute : absolute.parent_path();
}

/// Returns the absolute path without links, as far as it exists.
fs::path without_links(const fs::path& path) {
    std::error_code failed;
    fs::path all;
    for (const fs::path& part : fs::absolute(path, failed)) all = followed(all / part);
    const auto found = fs::weakly_canonical(all, failed);
    return normal(failed ? path : found);
}

/// Tells whether a path names a file or folder, or nothing yet, and no pipe or device.
bool can_be_replaced(const fs::path& path) {
    std::error_code failed;
    const auto type = fs::status(path, failed).type();
    return type == fs::file_type::not_found || type == fs::file_type::regular ||
           type == fs::file_type::directory;
}

/// Tells whether a path is in a folder; returns the rest of the path then.
bool is_inside(const fs::path& path, const fs::path& folder, fs::path& rest) {
    const auto [here, there] =
        std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    if (here != folder.end()) return false;
    rest.clear();
    for (auto part = there; part != path.end(); ++part) rest /= *part;
    return true;
}

/// Tells whether two paths without links are equal, or one of them is in the folder that the other is.
bool is_one_in_other(const fs::path& a, const fs::path& b) {
    fs::path rest;
    return is_inside(a, b, rest) || is_inside(b, a, rest);
}

/// Removes a folder and what is in it, without operator new: memory may be what is lacking.
void remove_folder(int above, const char* name) noexcept {
    const int folder = ::openat(above, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    if (DIR* const entries = ::fdopendir(folder)) {
        while (const dirent* const entry = ::readdir(entries)) {
            const std::string_view inner(entry->d_name);
            if (inner == "." || inner == "..") continue;
            if (::unlinkat(folder, entry->d_name, 0) != 0) remove_folder(folder, entry->d_name);
        }
        ::closedir(entries);
    } else {
        ::close(folder);
    }
    ::unlinkat(above, name, AT_REMOVEDIR);
}

} // namespace

FileSet::FileSet() {
    current_set = this;
}

FileSet::~FileSet() {
    current_set = nullptr;
    for (const Pending& p : pending_) discard_temporary(p.temporary);
}

FileSet* FileSet::current() {
    return current_set;
}

Status FileSet::add(fs::path temporary, fs::path target) {
    fs::path place = without_links(target);
    // A run can add hundreds of files, so they are compared by their names only.
    const auto meets = [&](const fs::path& other) { return is_one_in_other(place, other); };
    if (can_be_replaced(target)) {
        for (const Pending& p : pending_)
            if (meets(p.place))
                return Error{ErrorCode::bad_option,
                             "two results of this run would be in the same place, this and " +
                                 p.target.string(),
                             target.string()};
        if (std::any_of(kept_.begin(), kept_.end(), meets))
            return Error{ErrorCode::bad_option,
                         "a result of this run would replace this file, which is read",
                         target.string()};
    }
    pending_.push_back({std::move(temporary), std::move(target), std::move(place)});
    return Done{};
}

void FileSet::keep(const fs::path& file) {
    kept_.push_back(without_links(file));
}

void FileSet::then(std::function<void()> tell) {
    tells_.push_back(std::move(tell));
}

fs::path FileSet::where(const fs::path& path) const {
    const fs::path wanted = normal(path);
    fs::path rest;
    for (const Pending& p : pending_) // add() lets no two of them have the path
        if (is_inside(wanted, normal(p.target), rest))
            return rest.empty() ? p.temporary : p.temporary / rest;
    return path;
}

Status FileSet::publish() {
    std::string given; // needs no memory between the first name and the last
    std::size_t length = 0;
    for (const Pending& p : pending_) length += p.target.native().size() + 2;
    given.reserve(length);
    while (!pending_.empty()) {
        const Pending& p = pending_.front();
        std::error_code failed;
        fs::rename(p.temporary, p.target, failed); // a folder replaces an empty one
        if (failed)
            return Error{ErrorCode::write_failed,
                         "writing failed: " + failed.message() +
                             (given.empty() ? "" : "; written before: " + given),
                         p.target.string()};
        forget_temporary(p.temporary);
        if (!given.empty()) given += ", ";
        given += p.target.native();
        pending_.erase(pending_.begin());
    }
    for (const auto& tell : std::exchange(tells_, {})) tell();
    return Done{};
}

bool make_temporary(const fs::path& path, const fs::path& final_path,
                    const std::function<bool()>& make) {
    const std::lock_guard lock(temporaries().mutex);
    const auto noted = temporaries().finals.emplace(path, final_path);
    const bool made = make();
    if (!made && noted.second) temporaries().finals.erase(noted.first);
    return made;
}

bool are_same(const fs::path& a, const fs::path& b) {
    std::error_code failed;
    if (!can_be_replaced(a) || !can_be_replaced(b)) return false;
    if (fs::is_regular_file(a, failed) && fs::is_regular_file(b, failed))
        return fs::equivalent(a, b, failed);
    return without_links(a) == without_links(b);
}

bool overlap(const fs::path& a, const fs::path& b) {
    if (are_same(a, b)) return true;
    if (!can_be_replaced(a) || !can_be_replaced(b)) return false;
    return is_one_in_other(without_links(a), without_links(b));
}

void forget_temporary(const fs::path& path) {
    const std::lock_guard lock(temporaries().mutex);
    temporaries().finals.erase(path);
}

bool is_in_temporary(const fs::path& path) {
    const fs::path wanted = normal(path);
    fs::path rest;
    const std::lock_guard lock(temporaries().mutex);
    return std::any_of(
        temporaries().finals.begin(), temporaries().finals.end(),
        [&](const auto& folder) { return is_inside(wanted, normal(folder.first), rest); });
}

fs::path final_path_of(const fs::path& path) {
    const fs::path wanted = normal(path);
    fs::path rest;
    const std::lock_guard lock(temporaries().mutex);
    for (const auto& [temporary, final_path] : temporaries().finals)
        if (is_inside(wanted, normal(temporary), rest))
            return rest.empty() ? final_path : final_path / rest;
    return path;
}

void discard_temporary(const fs::path& path) noexcept {
    if (::unlink(path.c_str()) != 0) remove_folder(AT_FDCWD, path.c_str());
    forget_temporary(path);
}

std::unique_lock<std::mutex> remove_temporaries() {
    std::unique_lock lock(temporaries().mutex);
    std::error_code ignored;
    constexpr int tries = 20; // another thread may be putting files into a folder
    for (const auto& [path, final_path] : temporaries().finals)
        for (int k = 0; k < tries && fs::exists(path, ignored); ++k) fs::remove_all(path, ignored);
    return lock;
}

} // namespace terrane
