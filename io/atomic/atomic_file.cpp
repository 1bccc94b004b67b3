// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/atomic/atomic_file.hpp>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <terrane/io/atomic/file_set.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

std::string reason(int code) {
    return std::generic_category().message(code);
}

/// A file descriptor that is closed at the end of its scope, or earlier by close(), which reports
/// failure.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }

    [[nodiscard]] int number() const { return number_; }
    bool close() {
        const int number = std::exchange(number_, -1);
        return number < 0 || ::close(number) == 0;
    }

private:
    int number_;
};

/// Returns 0, or errno.
int write_all(int descriptor, std::string_view contents) {
    while (!contents.empty()) {
        const auto piece = std::min<std::size_t>(contents.size(), std::size_t(1) << 30);
        const auto written = ::write(descriptor, contents.data(), piece);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        contents.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

/// Appends the rest of the file to `contents`. Returns 0, or errno.
int read_all(int descriptor, std::string& contents) {
    constexpr std::size_t piece = std::size_t(1) << 20;
    std::size_t used = contents.size();
    while (true) {
        if (contents.size() - used < piece / 2) contents.resize(std::max(2 * used, used + piece));
        const auto read = ::read(descriptor, contents.data() + used, contents.size() - used);
        if (read < 0 && errno == EINTR) continue;
        if (read < 0) return errno;
        if (read == 0) break;
        used += static_cast<std::size_t>(read);
    }
    contents.resize(used);
    return 0;
}

Error write_error(const fs::path& path, int code) {
    return {ErrorCode::write_failed, "writing failed: " + reason(code), path.string()};
}

Status write_directly(const fs::path& path, int descriptor, std::string_view contents) {
    if (const int code = write_all(descriptor, contents)) return write_error(path, code);
    return Done{};
}

Status write_to_device(const fs::path& path, std::string_view contents) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.number() < 0)
        return Error{ErrorCode::cannot_open, "cannot be written: " + reason(errno), path.string()};
    if (auto status = write_directly(path, file.number(), contents); !status) return status;
    if (!file.close()) return write_error(path, errno);
    return Done{};
}

/// Returns a name in the folder of `target` that no other call of this process returns.
fs::path temporary_name(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    auto name = fmt::format(".{}.{}-{}.part", target.filename().string().substr(0, 200), ::getpid(),
                            counter++);
    return target.parent_path() / name;
}

/// Writes the contents, flushes them to the disk and closes the file. Returns 0, or errno.
int fill(Descriptor& file, std::string_view contents) {
    if (const int code = write_all(file.number(), contents)) return code;
    if (::fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP) return errno;
    return file.close() ? 0 : errno;
}

/// Writes a file of a folder that has no name yet: it needs none of its own, nor to be flushed alone.
Status write_in_place(const fs::path& path, std::string_view contents) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.number() < 0)
        return Error{ErrorCode::cannot_open, "cannot be written: " + reason(errno), path.string()};
    int code = write_all(file.number(), contents);
    if (code == 0 && !file.close()) code = errno;
    if (code == 0) return Done{};
    ::unlink(path.c_str());
    return write_error(path, code);
}

/// Where a file goes, with the name that the user gave.
struct Target {
    fs::path path;   ///< as it was given
    fs::path file;   ///< without links
    mode_t mode = 0; ///< of the file that is there; 0: there is none
};

/// A temporary file in the folder of the one that it is to become. It is removed at the end unless it was
/// handed on.
class TemporaryFile {
public:
    /// Makes the file and opens it. Errors: cannot_open.
    static Result<TemporaryFile> beside(const Target& to) {
        int code = 0;
        do {
            TemporaryFile made(temporary_name(to.file));
            const bool is_there = make_temporary(made.path_, to.path, [&] {
                made.number_ =
                    ::open(made.path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
                code = made.number_ < 0 ? errno : 0;
                return code == 0;
            });
            if (is_there) return made;
            made.path_.clear();
        } while (code == EEXIST);
        return Error{ErrorCode::cannot_open, "cannot be written: " + reason(code),
                     to.path.string()};
    }
    TemporaryFile(TemporaryFile&& other) noexcept :
        path_(std::exchange(other.path_, {})), number_(std::exchange(other.number_, -1)) {}
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile() {
        if (number_ >= 0) ::close(number_);
        if (!path_.empty()) discard_temporary(path_);
    }

    [[nodiscard]] const fs::path& path() const { return path_; }
    /// Returns the number of the open file, which is the caller's to close.
    int take_number() { return std::exchange(number_, -1); }
    /// Leaves the file to others.
    void hand_on() { path_.clear(); }

private:
    explicit TemporaryFile(fs::path path) : path_(std::move(path)) {}

    fs::path path_; ///< empty: there is no file to be removed
    int number_ = -1;
};

/// Writes a file under a temporary name and gives it its own, at once or with those of a set.
Status replace(const Target& to, std::string_view contents, FileSet* set) {
    auto made = TemporaryFile::beside(to);
    if (!made) return made.error();
    const fs::path& temporary = made->path();
    Descriptor file(made->take_number());
    int code = fill(file, contents);
    if (code == 0 && to.mode != 0 && ::chmod(temporary.c_str(), to.mode) != 0) code = errno;
    if (code == 0 && set != nullptr) {
        if (auto added = set->add(temporary, to.file); !added) return added;
        made->hand_on();
        return Done{};
    }
    if (code == 0 && ::rename(temporary.c_str(), to.file.c_str()) != 0) code = errno;
    if (code != 0) return write_error(to.path, code);
    forget_temporary(temporary);
    made->hand_on();
    return Done{};
}

Status write_to(const fs::path& path, std::string_view contents, FileSet* set) {
    if (path == "-") return write_directly("standard output", STDOUT_FILENO, contents);
    if (is_in_temporary(path)) return write_in_place(path, contents);
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0) // a link to nothing yet is kept
        return replace({path, followed(path)}, contents, set);
    if (S_ISDIR(info.st_mode))
        return Error{ErrorCode::cannot_open, "cannot be written: it is a folder", path.string()};
    if (!S_ISREG(info.st_mode)) return write_to_device(path, contents);
    if (::access(path.c_str(), W_OK) != 0) // renaming would replace even a protected file
        return Error{ErrorCode::cannot_open, "cannot be written: " + reason(errno), path.string()};
    std::error_code failed;
    const auto target = fs::canonical(path, failed);
    return replace({path, failed ? path : target, info.st_mode & 07777u}, contents, set);
}

/// Does the same; an error names the file as it is called when it is complete.
Status write_with(const fs::path& path, std::string_view contents, FileSet* set) {
    auto status = write_to(path, contents, set);
    if (status || path == "-" || status.error().place != path.string()) return status;
    return Error{status.error().code, status.error().sentence, final_path_of(path).string()};
}

} // namespace

Result<std::uint64_t> size_of_file(const fs::path& path) {
    const fs::path here = FileSet::current() != nullptr ? FileSet::current()->where(path) : path;
    struct stat info {};
    const int code = ::stat(here.c_str(), &info) != 0 ? errno : 0;
    if (code == 0 && S_ISREG(info.st_mode)) return static_cast<std::uint64_t>(info.st_size);
    return Error{ErrorCode::cannot_open,
                 code != 0 ? "cannot be read: " + reason(code) : "is no regular file",
                 final_path_of(path).string()};
}

Result<std::string> read_file(const fs::path& path) {
    const bool standard = path == "-";
    const fs::path here = FileSet::current() != nullptr ? FileSet::current()->where(path) : path;
    Descriptor file(standard ? ::dup(STDIN_FILENO) : ::open(here.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat info {};
    std::string contents;
    int code = file.number() < 0 || ::fstat(file.number(), &info) != 0 ? errno : 0;
    if (code == 0 && S_ISREG(info.st_mode))
        contents.reserve(std::size_t(info.st_size) + (1u << 20));
    if (code == 0) code = read_all(file.number(), contents);
    if (code == 0) return contents;
    return Error{ErrorCode::cannot_open, "cannot be read: " + reason(code),
                 standard ? "standard input" : final_path_of(path).string()};
}

fs::path followed(fs::path path) {
    constexpr int most_links = 40;
    std::error_code failed;
    for (int k = 0; k < most_links && fs::is_symlink(path, failed); ++k) {
        const fs::path to = fs::read_symlink(path, failed);
        if (failed) break;
        path = to.is_absolute() ? to : path.parent_path() / to;
    }
    return path;
}

Status write_file(const fs::path& path, std::string_view contents) {
    return write_with(path, contents, FileSet::current());
}

Status write_file_at_once(const fs::path& path, std::string_view contents) {
    return write_with(path, contents, nullptr);
}

} // namespace terrane
