// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/atomic/atomic_folder.hpp>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <terrane/io/atomic/file_set.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

Error cannot_make(std::string sentence, const fs::path& path) {
    return {ErrorCode::cannot_open, std::move(sentence), path.string()};
}

/// Removes the slash at the end: "out/", "out/." and "out" are the same folder.
fs::path without_slash(const fs::path& path) {
    fs::path name = path;
    while (!name.has_filename() || name.filename() == ".") {
        if (!name.has_parent_path() || name == name.parent_path()) break;
        name = name.parent_path();
    }
    return name;
}

fs::path parent_of(const fs::path& path) {
    const auto parent = path.parent_path();
    return parent.empty() ? fs::path(".") : parent;
}

/// Returns the reason for which the system does not say what a path is.
std::string reason_of_status(const fs::path& path) {
    std::error_code failed;
    static_cast<void>(fs::symlink_status(path, failed));
    return failed.message();
}

/// Tells whether something is mounted there: such a folder cannot be replaced.
bool is_mount_point(const fs::path& folder) {
#ifdef STATX_ATTR_MOUNT_ROOT
    struct statx found {};
    if (::statx(AT_FDCWD, folder.c_str(), AT_SYMLINK_NOFOLLOW, STATX_BASIC_STATS, &found) == 0 &&
        (found.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0)
        return (found.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
#endif
    struct stat here {
    }, above{};
    return ::stat(folder.c_str(), &here) == 0 && ::stat(parent_of(folder).c_str(), &above) == 0 &&
           here.st_dev != above.st_dev;
}

/// Tells what keeps an empty folder that is there from being replaced; null if nothing does.
const char* why_not_replaced(const fs::path& folder) {
    std::error_code failed;
    const auto name = folder.filename();
    if (name == "." || name == ".." || fs::equivalent(folder, ".", failed) ||
        !folder.has_filename())
        return "the folder in which the program runs, or one above it, cannot be replaced; name a "
               "new folder in it";
    if (!fs::is_empty(folder, failed) || failed) return "the folder is there already and not empty";
    if (is_mount_point(folder))
        return "something is mounted at this folder; name a new folder in it";
    if (::access(folder.c_str(), W_OK) != 0) return "nothing can be written in this folder";
    return nullptr;
}

/// Makes a new folder next to `target`, for its contents; returns its path.
Result<fs::path> make_beside(const fs::path& target, const fs::path& path) {
    for (unsigned k = 0;; ++k) {
        auto temporary =
            parent_of(target) /
            fmt::format(".{}.{}-{}.part", target.filename().string().substr(0, 200), ::getpid(), k);
        std::error_code failed;
        if (make_temporary(temporary, target,
                           [&] { return fs::create_directory(temporary, failed); }))
            return temporary;
        if (failed) return cannot_make("the folder cannot be made: " + failed.message(), path);
    }
}

Error write_error(const fs::path& path, const std::string& reason) {
    return {ErrorCode::write_failed, "writing failed: " + reason, path.string()};
}

/// Flushes the file system that holds a folder: one call for any number of files. Returns 0, or errno.
int flush(const fs::path& folder) {
    const int number = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (number < 0) return errno;
    const int code = ::syncfs(number) == 0 ? 0 : errno;
    ::close(number);
    return code == EINVAL || code == ENOTSUP || code == ENOSYS ? 0 : code;
}

} // namespace

Status check_new_folder(const fs::path& path) {
    const fs::path target = without_slash(path);
    std::error_code failed;
    if (fs::is_symlink(target, failed))
        return cannot_make("this is a link; name the folder itself, or a new one", path);
    const auto there = fs::symlink_status(target, failed).type();
    if (there == fs::file_type::directory) {
        if (const char* const why = why_not_replaced(target)) return cannot_make(why, path);
    } else if (there != fs::file_type::not_found && there != fs::file_type::none) {
        return cannot_make("this is no folder", path);
    }
    const fs::path parent = parent_of(target);
    if (target.empty() || !fs::is_directory(parent, failed))
        return cannot_make("there is no folder " + parent.string(), path);
    if (there == fs::file_type::none) // its name is too long, say
        return cannot_make("the folder cannot be made: " + reason_of_status(target), path);
    if (::access(parent.c_str(), W_OK) != 0)
        return cannot_make("nothing can be written in " + parent.string(), path);
    // Only trying tells that a folder can be made: the rights of root, for one, say nothing.
    const auto made = make_beside(target, path);
    if (!made) return made.error();
    discard_temporary(*made);
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
    if (!temporary_.empty()) discard_temporary(temporary_);
}

Result<NewFolder> NewFolder::create(const fs::path& path) {
    if (const auto good = check_new_folder(path); !good) return good.error();
    NewFolder folder(without_slash(path), {});
    auto made = make_beside(folder.target_, path);
    if (!made) return made.error();
    folder.temporary_ = std::move(made).value();
    return folder;
}

Status NewFolder::publish() {
    if (const int code = flush(temporary_))
        return write_error(target_, std::generic_category().message(code));
    if (FileSet::current() != nullptr) {
        if (auto added = FileSet::current()->add(temporary_, target_); !added) return added;
        temporary_.clear();
        return Done{};
    }
    std::error_code failed;
    fs::rename(temporary_, target_, failed); // replaces an empty folder
    if (failed) return write_error(target_, failed.message());
    forget_temporary(temporary_);
    temporary_.clear();
    return Done{};
}

} // namespace terrane
