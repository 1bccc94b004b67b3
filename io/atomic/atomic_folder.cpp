// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/atomic/atomic_folder.hpp>

#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include <terrane/io/atomic/file_set.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

Error cannot_make(std::string sentence, const fs::path& path) {
    return {ErrorCode::cannot_open, std::move(sentence), path.string()};
}

/// Removes the slash at the end: "out/" and "out" are the same folder.
fs::path without_slash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

fs::path parent_of(const fs::path& path) {
    const auto parent = path.parent_path();
    return parent.empty() ? fs::path(".") : parent;
}

} // namespace

Status check_new_folder(const fs::path& path) {
    const fs::path target = without_slash(path);
    std::error_code failed;
    if (fs::is_directory(target, failed)) {
        if (!fs::is_empty(target, failed) || failed)
            return cannot_make("the folder is there already and not empty", path);
    } else if (fs::exists(target, failed)) {
        return cannot_make("this is no folder", path);
    }
    const fs::path parent = parent_of(target);
    if (target.empty() || !fs::is_directory(parent, failed))
        return cannot_make("there is no folder " + parent.string(), path);
    if (::access(parent.c_str(), W_OK) != 0)
        return cannot_make("nothing can be written in " + parent.string(), path);
    return Done{};
}

NewFolder::NewFolder(fs::path target, fs::path temporary) :
    target_(std::move(target)), temporary_(std::move(temporary)) {}
NewFolder::NewFolder(NewFolder&& other) noexcept :
    target_(std::move(other.target_)), temporary_(std::exchange(other.temporary_, {})) {}

NewFolder& NewFolder::operator=(NewFolder&& other) noexcept {
    std::swap(target_, other.target_);
    std::swap(temporary_, other.temporary_);
    return *this;
}

NewFolder::~NewFolder() {
    std::error_code ignored;
    if (temporary_.empty()) return;
    fs::remove_all(temporary_, ignored);
    forget_temporary(temporary_);
}

Result<NewFolder> NewFolder::create(const fs::path& path) {
    if (const auto good = check_new_folder(path); !good) return good.error();
    const fs::path target = without_slash(path);
    for (unsigned k = 0;; ++k) {
        const auto temporary =
            parent_of(target) /
            fmt::format(".{}.{}-{}.part", target.filename().string().substr(0, 200), ::getpid(), k);
        std::error_code failed;
        if (fs::create_directory(temporary, failed)) {
            note_temporary(temporary);
            return NewFolder(target, temporary);
        }
        if (failed) return cannot_make("the folder cannot be made: " + failed.message(), path);
    }
}

Status NewFolder::publish() {
    if (FileSet::current() != nullptr) {
        FileSet::current()->add(std::exchange(temporary_, {}), target_);
        return Done{};
    }
    std::error_code failed;
    fs::rename(temporary_, target_, failed); // replaces an empty folder
    if (failed)
        return Error{ErrorCode::write_failed, "writing failed: " + failed.message(),
                     target_.string()};
    forget_temporary(temporary_);
    temporary_.clear();
    return Done{};
}

} // namespace terrane
