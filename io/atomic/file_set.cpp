// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/atomic/file_set.hpp>

#include <algorithm>
#include <mutex>
#include <new>
#include <set>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace terrane {

namespace fs = std::filesystem;

namespace {

thread_local FileSet* current_set = nullptr;

/// The temporary files and folders of this process.
struct Temporaries {
    std::mutex mutex;
    std::set<fs::path> paths;
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

/// Tells whether a path is in a folder; returns the rest of the path then.
bool is_inside(const fs::path& path, const fs::path& folder, fs::path& rest) {
    const auto [here, there] =
        std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    if (here != folder.end()) return false;
    rest.clear();
    for (auto part = there; part != path.end(); ++part) rest /= *part;
    return true;
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

void FileSet::add(fs::path temporary, fs::path target) {
    pending_.push_back({std::move(temporary), std::move(target)});
}

void FileSet::then(std::function<void()> tell) {
    tells_.push_back(std::move(tell));
}

fs::path FileSet::where(const fs::path& path) const {
    const fs::path wanted = normal(path);
    fs::path rest;
    for (auto p = pending_.rbegin(); p != pending_.rend(); ++p)
        if (is_inside(wanted, normal(p->target), rest))
            return rest.empty() ? p->temporary : p->temporary / rest;
    return path;
}

Status FileSet::publish() {
    std::string given;
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
        given += (given.empty() ? "" : ", ") + p.target.string();
        pending_.erase(pending_.begin());
    }
    for (const auto& tell : std::exchange(tells_, {})) tell();
    return Done{};
}

bool make_temporary(const fs::path& path, const std::function<bool()>& make) {
    const std::lock_guard lock(temporaries().mutex);
    const auto noted = temporaries().paths.insert(path);
    const bool made = make();
    if (!made && noted.second) temporaries().paths.erase(noted.first);
    return made;
}

void forget_temporary(const fs::path& path) {
    const std::lock_guard lock(temporaries().mutex);
    temporaries().paths.erase(path);
}

bool is_in_temporary(const fs::path& path) {
    const fs::path wanted = normal(path);
    fs::path rest;
    const std::lock_guard lock(temporaries().mutex);
    return std::any_of(
        temporaries().paths.begin(), temporaries().paths.end(),
        [&](const fs::path& folder) { return is_inside(wanted, normal(folder), rest); });
}

void discard_temporary(const fs::path& path) noexcept {
    if (::unlink(path.c_str()) != 0) { // it is a folder
        constexpr int tries = 3;
        for (int k = 0; k < tries; ++k) {
            try {
                std::error_code ignored;
                fs::remove_all(path, ignored);
                break;
            } catch (const std::bad_alloc&) {
                continue;
            }
        }
    }
    forget_temporary(path);
}

std::unique_lock<std::mutex> remove_temporaries() {
    std::unique_lock lock(temporaries().mutex);
    std::error_code ignored;
    constexpr int tries = 20; // another thread may be putting files into a folder
    for (const fs::path& path : temporaries().paths)
        for (int k = 0; k < tries && fs::exists(path, ignored); ++k) fs::remove_all(path, ignored);
    return lock;
}

} // namespace terrane
