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

Status replace(const fs::path& path, const fs::path& target, mode_t mode,
               std::string_view contents) {
    fs::path temporary;
    int number = -1;
    do {
        temporary = temporary_name(target);
        number = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (number < 0 && errno == EEXIST);
    Descriptor file(number);
    if (file.number() < 0)
        return Error{ErrorCode::cannot_open, "cannot be written: " + reason(errno), path.string()};
    int code = fill(file, contents);
    if (code == 0 && mode != 0 && ::chmod(temporary.c_str(), mode) != 0) code = errno;
    if (code == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) code = errno;
    if (code == 0) return Done{};
    ::unlink(temporary.c_str());
    return write_error(path, code);
}

} // namespace

Result<std::string> read_file(const fs::path& path) {
    const bool standard = path == "-";
    Descriptor file(standard ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat info {};
    std::string contents;
    int code = file.number() < 0 || ::fstat(file.number(), &info) != 0 ? errno : 0;
    if (code == 0 && S_ISREG(info.st_mode))
        contents.reserve(std::size_t(info.st_size) + (1u << 20));
    if (code == 0) code = read_all(file.number(), contents);
    if (code == 0) return contents;
    return Error{ErrorCode::cannot_open, "cannot be read: " + reason(code),
                 standard ? "standard input" : path.string()};
}

Status write_file(const fs::path& path, std::string_view contents) {
    if (path == "-") return write_directly("standard output", STDOUT_FILENO, contents);
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0) return replace(path, path, 0, contents);
    if (S_ISDIR(info.st_mode))
        return Error{ErrorCode::cannot_open, "cannot be written: it is a folder", path.string()};
    if (!S_ISREG(info.st_mode)) return write_to_device(path, contents);
    if (::access(path.c_str(), W_OK) != 0) // renaming would replace even a protected file
        return Error{ErrorCode::cannot_open, "cannot be written: " + reason(errno), path.string()};
    std::error_code failed;
    const auto target = fs::canonical(path, failed);
    return replace(path, failed ? path : target, info.st_mode & 07777u, contents);
}

} // namespace terrane
